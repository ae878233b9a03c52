//! The shader files, and joining those that an entry needs.

use crate::constants::shared;
use std::fmt::Write;

/// Every shader file by its name below `shaders/`, without `.wgsl`.
macro_rules! modules {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../shaders/", $name, ".wgsl")))),*]
    };
}

/// All files.
pub const MODULES: &[(&str, &str)] = modules![
    "brdf/albedo",
    "brdf/beckmann",
    "brdf/fresnel",
    "brdf/ggx",
    "brdf/ggx_local",
    "brdf/gltf",
    "brdf/roughness",
    "brdf/visible",
    "data/emitters",
    "data/host",
    "data/index",
    "data/lights",
    "data/nearest",
    "data/partition",
    "data/point_sender",
    "data/receivers",
    "data/scan",
    "data/scan_counts",
    "data/scene",
    "data/sums",
    "data/texel",
    "data/view",
    "data/vsgls",
    "data/vsgls_read",
    "data/vsgls_write",
    "data/words",
    "entry/best",
    "entry/camera_map",
    "entry/cluster",
    "entry/emitters",
    "entry/export",
    "entry/filtered",
    "entry/gbuffer",
    "entry/import_gbuffer",
    "entry/import_rsm",
    "entry/importance",
    "entry/leaves",
    "entry/nearest",
    "entry/occlusion",
    "entry/partition",
    "entry/path",
    "entry/pdf",
    "entry/raster",
    "entry/reconstruct",
    "entry/resolve",
    "entry/round",
    "entry/rsm",
    "entry/sampled",
    "entry/senders",
    "entry/shade",
    "entry/sort",
    "entry/whole",
    "geom/hit",
    "geom/ray",
    "geom/traverse",
    "geom/triangle",
    "math/elementary",
    "math/moments",
    "math/sobol",
    "math/vec",
    "phase/anisotropy",
    "phase/bsdf",
    "phase/camera_map",
    "phase/cluster",
    "phase/color",
    "phase/direct",
    "phase/draw",
    "phase/emit",
    "phase/facing",
    "phase/fill",
    "phase/facet",
    "phase/filtered",
    "phase/filtered_box",
    "phase/footprint",
    "phase/gbuffer",
    "phase/importance",
    "phase/interleave",
    "phase/mask",
    "phase/lift",
    "phase/nearest",
    "phase/normal_map",
    "phase/occlusion",
    "phase/partition",
    "phase/path",
    "phase/pdf",
    "phase/reconstruct",
    "phase/reflect",
    "phase/resolve",
    "phase/rsm",
    "phase/run",
    "phase/sampled",
    "phase/shade",
    "phase/splat",
    "phase/surface",
    "phase/texture",
    "phase/unit",
    "sg/anisotropic",
    "sg/asg",
    "sg/cosine",
    "sg/extent",
    "sg/filtering",
    "sg/glossy",
    "sg/glossy_blend",
    "sg/hemisphere",
    "sg/lobe",
    "sg/polar",
    "sg/vmf",
    "sg/warp",
];

/// Text of a file.
///
/// # Panics
/// If there is no file of that name: a mistake in this crate.
fn text(name: &str) -> &'static str {
    let found = MODULES.iter().find(|(n, _)| *n == name);
    found.map_or_else(|| panic!("no shader file `{name}`"), |(_, text)| text)
}

/// The files that a text names in its `//! needs:` lines.
fn needs(text: &str) -> impl Iterator<Item = &str> {
    text.lines()
        .filter_map(|line| line.strip_prefix("//! needs:"))
        .flat_map(|names| names.split(','))
        .map(str::trim)
}

/// One text from files and all that they need: each once, after what it needs, and constants first.
///
/// # Panics
/// If a file needs one that does not exist, or itself: a mistake in this crate, which a test finds.
pub fn link(names: &[&str]) -> String {
    let mut order = Vec::new();
    for name in names {
        visit(name, &mut order, &mut Vec::new());
    }
    let mut linked = String::new();
    for name in order {
        // Errors of the compiler are read beside the file's name.
        let _ = writeln!(linked, "// {name}.wgsl");
        linked.push_str(text(name));
        linked.push('\n');
    }
    format!("{}{}{linked}", header(), shared(&linked))
}

fn visit<'a>(name: &'a str, order: &mut Vec<&'a str>, above: &mut Vec<&'a str>) {
    if order.contains(&name) {
        return;
    }
    assert!(!above.contains(&name), "shader file `{name}` needs itself");
    above.push(name);
    for needed in needs(text(name)) {
        visit(needed, order, above);
    }
    above.pop();
    order.push(name);
}

/// 32-bit words of a record.
const fn words<T>() -> u32 {
    (size_of::<T>() / 4) as u32
}

/// Constants of phases and geometry, written once in Rust.
fn header() -> String {
    use vsgl_core::data::{self, map_kind};
    use vsgl_core::phase::{
        bsdf, cluster, direct, draw, facet, facing, fill, filtered_box, footprint, importance,
        interleave, nearest, normal_map, occlusion, partition, path, pdf, reconstruct, rsm, run,
        sampled, shade, splat, surface, texture, whole,
    };
    let floats: &[(&str, f32)] = &[
        ("ALPHA_MIN", surface::ALPHA_MIN),
        ("FOOTPRINT_COSINE_MIN", rsm::FOOTPRINT_COSINE_MIN),
        ("VARIANCE_MIN", shade::VARIANCE_MIN),
        ("LIFT", facing::LIFT),
        ("SLAB_EXIT", vsgl_core::geom::SLAB_EXIT),
        ("STRENGTH_MAX", direct::STRENGTH_MAX),
        ("MAP_CONE", map_kind::CONE),
        ("MAP_FACE", map_kind::FACE),
        ("MAP_PARALLEL", map_kind::PARALLEL),
        ("MAP_EMITTERS", map_kind::EMITTERS),
        ("NORMAL_SCALE", partition::NORMAL_SCALE),
        ("BELOW_ONE", pdf::BELOW_ONE),
        ("IMPORTANCE_FLOOR", importance::FLOOR),
        ("IMPORTANCE_KEPT", importance::KEPT),
        ("IMPORTANCE_MAX", importance::IMPORTANCE_MAX),
        ("BOX_CELLS", filtered_box::CELLS),
        ("BOX_LEAST", filtered_box::LEAST),
        ("NEAREST_FAR", nearest::FAR),
        ("CHANCE_MIN", bsdf::CHANCE_MIN),
        ("DRAW_PARTS", draw::PARTS as f32),
        ("GO_ON_LEAST", path::GO_ON[0]),
        ("GO_ON_MOST", path::GO_ON[1]),
        ("GRAZING_MIN", footprint::GRAZING_MIN),
        ("HORIZON", normal_map::HORIZON),
        ("TANGENT_MIN", normal_map::TANGENT_MIN),
        ("AXIS_MAX", texture::AXIS_MAX),
        ("HALF_LOG2_E", texture::HALF_LOG2_E),
        ("FAINT", reconstruct::FAINT),
        ("SLOPE_MAX", reconstruct::SLOPE_MAX),
        ("TURN_MAX", reconstruct::TURN_MAX),
        ("ROUGHNESS_FALL", reconstruct::ROUGHNESS_FALL),
        ("FACET_STEEPEST", facet::STEEPEST),
        ("FACET_WIDEST", facet::WIDEST),
        ("FILL_CONSISTENT", fill::CONSISTENT),
        ("OCCLUSION_BIAS", occlusion::BIAS),
        ("RUN_APART", run::APART),
        ("SPLAT_BACK", splat::BACK),
        ("SPLAT_OVERLAP", splat::OVERLAP),
        ("SPLAT_PIECES", splat::PIECES),
        ("SPLAT_REACH", splat::REACH),
        ("SPLAT_TEXELS_A_RADIAN", splat::TEXELS_A_RADIAN),
        ("SPLAT_THIRD", splat::THIRD),
        ("SPLAT_TWO_THIRDS", splat::TWO_THIRDS),
    ];
    let integers: &[(&str, u32)] = &[
        ("NO_TRIANGLE", data::NO_TRIANGLE),
        ("NO_TEXTURE", data::NO_TEXTURE),
        ("NO_WORDS", crate::params::NO_WORDS),
        ("MATERIAL_WORDS", words::<data::MaterialRecord>()),
        ("TEXTURE_WORDS", words::<data::TextureRecord>()),
        ("DOUBLE_SIDED", data::DOUBLE_SIDED),
        ("UNLIT", data::UNLIT),
        ("NEAREST", data::NEAREST),
        ("MIPS", data::MIPS),
        ("SECOND_SET", data::SECOND_SET),
        ("TAPS", texture::TAPS),
        ("STACK", vsgl_core::geom::STACK as u32),
        ("TEXEL_SIDE", crate::texels::SIDE),
        ("INVOCATIONS", crate::kernel::INVOCATIONS),
        ("GOLDEN_TURN", pdf::GOLDEN_TURN),
        ("INTERLEAVE", importance::INTERLEAVE),
        ("PATH_PAIRS", path::PAIRS),
        ("ROULETTE_DEPTH", path::ROULETTE_DEPTH),
        ("PARTITION_BLOCK", partition::BLOCK as u32),
        ("PARTITION_LANES", partition::LANES as u32),
        ("WHOLE_CHUNK", whole::CHUNK as u32),
        ("WHOLE_LANES", whole::LANES as u32),
        ("BOX_LANES", filtered_box::LANES as u32),
        ("NEAREST_WIDTH", nearest::WIDTH as u32),
        ("SORT_BLOCK", crate::passes::SORT_BLOCK),
        ("CLUSTER_BLOCK", cluster::BLOCK as u32),
        ("CLUSTER_LANES", cluster::LANES as u32),
        ("TILE", interleave::TILE),
        ("STEP_X", sampled::STEP_X),
        ("STEP_Y", sampled::STEP_Y),
        ("RAYS_MAX", vsgl_core::settings::Settings::RAYS_MAX),
        ("RUN_DRAWS", run::DRAWS),
        ("RUN_MAX", run::RUN_MAX),
        ("SPLAT_PIECES_MAX", splat::PIECES_MAX),
    ];
    let mut text = String::new();
    for (name, value) in floats {
        // The shortest decimal that reads back as the same bits.
        let _ = writeln!(text, "const {name}: f32 = {value:e}f;");
    }
    for (name, value) in integers {
        let _ = writeln!(text, "const {name}: u32 = {value}u;");
    }
    text
}
