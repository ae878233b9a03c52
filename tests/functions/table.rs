//! What an entry of the table is.

use super::arguments::Kind;
use vsgl_core::brdf::albedo::Albedo;
use vsgl_core::brdf::roughness::Roughness;
use vsgl_core::geom::Ray;
use vsgl_core::glam::Vec3;
use vsgl_core::math::moments::{Moments, Scatter};
use vsgl_core::phase::nearest::Nearest;
use vsgl_core::phase::partition::{Features, Statistics};
use vsgl_core::phase::shade::Incoming;
use vsgl_core::sg::asg::AsgLobe;
use vsgl_core::sg::lobe::SgLobe;
use vsgl_core::sg::polar::PolarMoments;
use vsgl_core::sg::vmf::MeanLength;

/// A call in Rust, which appends the numbers of its result.
type Call = Box<dyn Fn(&Arguments<'_>, &mut Vec<f32>)>;

/// A size by arguments and part.
type Scale = Box<dyn Fn(&Arguments<'_>, usize) -> f32>;

/// A function in both languages.
pub(super) struct Entry {
    /// Shader file that holds it.
    pub(super) file: &'static str,
    /// Its name there, for reports.
    pub(super) name: &'static str,
    /// Its arguments.
    pub(super) kinds: Vec<Kind>,
    /// The call in WGSL, of `x0`, `x1` …
    pub(super) call: String,
    /// More text in WGSL.
    pub(super) text: &'static str,
    /// Parts of the result in WGSL, each a group of numbers of one size; `r` is the result.
    pub(super) parts: &'static [&'static [&'static str]],
    /// The call in Rust: from arguments to the numbers of all parts.
    pub(super) rust: Call,
    /// Error in the ordinary path over the size of a part.
    pub(super) relative: f32,
    /// Size of a part, by its number, where its numbers are smaller.
    pub(super) scale: Scale,
}

/// The arguments of one call.
pub(super) struct Arguments<'a> {
    pub(super) kinds: &'a [Kind],
    pub(super) row: &'a [f32],
}

impl Arguments<'_> {
    fn place(&self, i: usize) -> usize {
        self.kinds[..i].iter().map(|k| k.width()).sum()
    }

    /// Argument `i`, a number.
    pub(super) fn f(&self, i: usize) -> f32 {
        self.row[self.place(i)]
    }

    /// Argument `i`, a unit vector in a plane.
    pub(super) fn turn(&self, i: usize) -> (f32, f32) {
        let at = self.place(i);
        (self.row[at], self.row[at + 1])
    }

    /// Argument `i`, a vector.
    pub(super) fn v(&self, i: usize) -> Vec3 {
        Vec3::from_slice(&self.row[self.place(i)..])
    }
}

/// A result that can be compared.
pub(super) trait Flat {
    const PARTS: &'static [&'static [&'static str]];
    fn flat(self, out: &mut Vec<f32>);
}

macro_rules! flat {
    ($kind:ty: $([$($part:literal),*]),* ; $value:ident => $($number:expr),*) => {
        impl Flat for $kind {
            const PARTS: &'static [&'static [&'static str]] = &[$(&[$($part),*]),*];
            fn flat(self, out: &mut Vec<f32>) {
                let $value = self;
                out.extend([$($number),*]);
            }
        }
    };
}

flat!(f32: ["r"]; x => x);
flat!(u32: ["f32(r)"]; x => x as f32);
flat!((f32, f32): ["r.x"], ["r.y"]; x => x.0, x.1);
flat!((f32, f32, f32): ["r.x"], ["r.y"], ["r.z"]; x => x.0, x.1, x.2);
flat!(Vec3: ["r.x", "r.y", "r.z"]; v => v.x, v.y, v.z);
flat!((Vec3, Vec3): ["r.x.x", "r.x.y", "r.x.z"], ["r.y.x", "r.y.y", "r.y.z"];
    v => v.0.x, v.0.y, v.0.z, v.1.x, v.1.y, v.1.z);
flat!(Moments: ["r.mean.x", "r.mean.y", "r.mean.z"], ["r.spread"];
    m => m.mean.x, m.mean.y, m.mean.z, m.spread);
flat!(Scatter: ["r.mean.x", "r.mean.y", "r.mean.z"], ["r.diagonal.x", "r.diagonal.y", "r.diagonal.z"],
    ["r.rest.x", "r.rest.y", "r.rest.z"];
    m => m.mean.x, m.mean.y, m.mean.z, m.diagonal.x, m.diagonal.y, m.diagonal.z, m.rest.x, m.rest.y, m.rest.z);
flat!(SgLobe: ["r.axis.x", "r.axis.y", "r.axis.z"], ["r.sharpness"], ["r.log_amplitude"];
    l => l.axis.x, l.axis.y, l.axis.z, l.sharpness, l.log_amplitude);
flat!(AsgLobe: ["r.x.x", "r.x.y", "r.x.z"], ["r.y.x", "r.y.y", "r.y.z"], ["r.z.x", "r.z.y", "r.z.z"],
    ["r.sharpness_x"], ["r.sharpness_y"];
    l => l.x.x, l.x.y, l.x.z, l.y.x, l.y.y, l.y.z, l.z.x, l.z.y, l.z.z, l.sharpness_x, l.sharpness_y);
flat!(Incoming: ["r.axis.x", "r.axis.y", "r.axis.z"], ["r.sharpness"], ["r.horizon"],
    ["r.strength.x", "r.strength.y", "r.strength.z"];
    i => i.axis.x, i.axis.y, i.axis.z, i.sharpness, i.horizon, i.strength.x, i.strength.y, i.strength.z);
flat!(Ray: ["r.origin.x", "r.origin.y", "r.origin.z"], ["r.direction.x", "r.direction.y", "r.direction.z"],
    ["r.inverse.x"], ["r.inverse.y"], ["r.inverse.z"];
    r => r.origin.x, r.origin.y, r.origin.z, r.direction.x, r.direction.y, r.direction.z,
    r.inverse.x, r.inverse.y, r.inverse.z);
flat!(Features: ["r.weight"], ["r.position.x", "r.position.y", "r.position.z"],
    ["r.normal.x", "r.normal.y", "r.normal.z"],
    ["r.deviation_position.x", "r.deviation_position.y", "r.deviation_position.z"],
    ["r.deviation_normal.x", "r.deviation_normal.y", "r.deviation_normal.z"];
    f => f.weight, f.mean[0], f.mean[1], f.mean[2], f.mean[4], f.mean[5], f.mean[6],
    f.deviation[0], f.deviation[1], f.deviation[2], f.deviation[4], f.deviation[5], f.deviation[6]);
flat!((u32, u32, f32): ["f32(r.column)"], ["f32(r.row)"], ["r.share"];
    c => c.0 as f32, c.1 as f32, c.2);
flat!(Nearest: ["f32(r.number)"], ["r.distance2"]; n => n.number as f32, n.distance2);
flat!(Statistics: ["r.priority"], ["f32(r.axis)"], ["r.threshold"];
    s => s.priority, s.axis as f32, s.threshold);
flat!(MeanLength: ["r.length"], ["r.complement"]; m => m.length, m.complement);
flat!(PolarMoments: ["r.decay"], ["r.mass"], ["r.upper"], ["r.lower"];
    m => m.decay, m.mass, m.upper, m.lower);
flat!(Albedo: ["r.a"], ["r.b"]; m => m.a, m.b);
flat!(Roughness: ["r.xx", "r.xy", "r.yy"], ["r.determinant"]; m => m.xx, m.xy, m.yy, m.determinant);

/// A function of the arguments in their order.
pub(super) fn entry<T: Flat>(
    file: &'static str,
    name: &'static str,
    kinds: &[Kind],
    rust: impl Fn(&Arguments<'_>) -> T + 'static,
) -> Entry {
    let names: Vec<String> = (0..kinds.len()).map(|i| format!("x{i}")).collect();
    Entry {
        file,
        name,
        kinds: kinds.to_vec(),
        call: format!("{name}({})", names.join(", ")),
        text: "",
        parts: T::PARTS,
        rust: Box::new(move |a, out| rust(a).flat(out)),
        relative: 1e-5,
        scale: Box::new(|_, _| 0.0),
    }
}

impl Entry {
    /// Called by this text instead.
    pub(super) fn by(mut self, call: &str) -> Self {
        self.call = call.to_owned();
        self
    }

    /// With functions for the call.
    pub(super) fn with(mut self, text: &'static str) -> Self {
        self.text = text;
        self
    }

    /// In the ordinary path: relative error, for what magnifies the rounding of its arguments.
    pub(super) fn within(mut self, relative: f32) -> Self {
        self.relative = relative;
        self
    }

    /// In the ordinary path: the size that errors are measured against where results are smaller, being differences or
    /// products with a share.
    pub(super) fn scale(self, scale: impl Fn(&Arguments<'_>) -> f32 + 'static) -> Self {
        self.scales(move |a, _| scale(a))
    }

    /// The same by parts.
    pub(super) fn scales(mut self, scale: impl Fn(&Arguments<'_>, usize) -> f32 + 'static) -> Self {
        self.scale = Box::new(scale);
        self
    }

    /// The same, a constant.
    pub(super) fn floor(self, floor: f32) -> Self {
        self.scale(move |_| floor)
    }

    /// Numbers of an argument row.
    pub(super) fn width(&self) -> usize {
        self.kinds.iter().map(|k| k.width()).sum()
    }

    /// Numbers of a result.
    pub(super) fn results(&self) -> usize {
        self.parts.iter().map(|p| p.len()).sum()
    }

    /// The shader's own part: one call an invocation.
    pub(super) fn shader(&self) -> String {
        let width = self.width();
        let mut text = String::from(
            "@group(0) @binding(0) var<storage, read> probe_arguments: array<f32>;\n\
             @group(0) @binding(1) var<storage, read_write> probe_results: array<f32>;\n\
             @compute @workgroup_size(64)\n\
             fn main(@builtin(global_invocation_id) probe_id: vec3<u32>) {\n",
        );
        let mut at = 0;
        for (i, kind) in self.kinds.iter().enumerate() {
            let number = |j: usize| format!("probe_arguments[probe_id.x * {width}u + {}u]", at + j);
            let value = match kind.width() {
                3 => format!("vec3({}, {}, {})", number(0), number(1), number(2)),
                2 => format!("vec2({}, {})", number(0), number(1)),
                _ => number(0),
            };
            text.push_str(&format!("    let x{i} = {value};\n"));
            at += kind.width();
        }
        text.push_str(&format!("    let r = {};\n", self.call));
        for (i, part) in self.parts.concat().iter().enumerate() {
            let results = self.results();
            text.push_str(&format!(
                "    probe_results[probe_id.x * {results}u + {i}u] = {part};\n"
            ));
        }
        text.push_str("}\n");
        text + self.text
    }
}
