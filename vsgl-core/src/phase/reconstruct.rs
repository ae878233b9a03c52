//! From sums over a share of the virtual lights at each sample to the light of all of them.
//!
//! Each share of the lights is at hand at up to four samples around a sample: their mean by tent weights, which add up to the
//! same number for every share, times the likeness of the surfaces. The sum over the shares is the light. On an even surface
//! that is interpolation; at an edge every share still counts once, from the samples on the right side of the edge. Where a
//! share is on no such sample, the mean of the others stands in for it.
//!
//! The visibility of rays that were drawn is a ratio: contributions that arrive over all, each summed over the neighbourhood.

use super::interleave::Shares;
use super::shade::Colors;
use crate::data::{GBuffer, NO_TRIANGLE, Radiance, SampleSums};
use crate::plan::ReconstructPlan;
use glam::Vec3;

/// Greatest slope of a neighbour over a sample's plane, squared: beyond it the neighbour is another surface.
pub const SLOPE_MAX: f32 = 0.25;
/// Greatest "one minus cosine" between normals of one surface.
pub const TURN_MAX: f32 = 0.5;
/// How fast the likeness of specular sums falls with the squared difference of roughnesses over their product.
pub const ROUGHNESS_FALL: f32 = 16.0;
/// Samples along a side of the square over which visibility is taken together, at least.
pub const FILTER: u32 = 4;

/// Sums below are no light \[W/m²\]: where a device takes numbers below the normal ones for zero, such sums are what is left of
/// products that it lost.
pub const FAINT: f32 = 1e-30;

/// Sums that shading leaves, without what is too faint.
#[inline(always)]
pub fn lit(sums: [f32; 3]) -> [f32; 3] {
    sums.map(|sum| if sum < FAINT { 0.0 } else { sum })
}

/// What decides whether two samples are alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Position \[m\].
    pub position: Vec3,
    /// Unit shading normal.
    pub normal: Vec3,
    /// GGX roughness; 1 where nothing is glossy.
    pub alpha: f32,
}

impl Patch {
    /// The surface at a sample that hit something.
    pub fn of(gbuffer: &GBuffer, sample: usize) -> Self {
        let [x, y, z, _] = gbuffer.position[sample];
        let [nx, ny, nz, _] = gbuffer.normal[sample];
        Self {
            position: Vec3::new(x, y, z),
            normal: Vec3::new(nx, ny, nz),
            alpha: gbuffer.specular.get(sample).map_or(1.0, |s| s[3]),
        }
    }

    /// Likeness of the sums of two samples for the Lambert part and for the specular part, 0 … 1; zero on another surface.
    ///
    /// By slopes, not by distances from a plane in pixels: no length has to be chosen, and it holds at any angle.
    #[inline(always)]
    pub fn likeness(&self, other: &Self) -> (f32, f32) {
        let apart = other.position - self.position;
        let distance2 = apart.dot(apart);
        let (here, there) = (apart.dot(self.normal), apart.dot(other.normal));
        // On a curved surface one of the planes may do.
        let off2 = (here * here).min(there * there);
        let slope2 = off2 / distance2.max(f32::MIN_POSITIVE);
        let plane = (1.0 - slope2 * (1.0 / SLOPE_MAX)).max(0.0);
        let apart = self.normal - other.normal;
        let turn = 0.5 * apart.dot(apart);
        let facing = (1.0 - turn * (1.0 / TURN_MAX)).max(0.0);
        let diffuse = plane * (facing * facing);
        // Not less for smooth surfaces, whose reflections turn faster: of each share the one best neighbour would be taken, and
        // a curved metal would be tiled.
        let product = (self.alpha * other.alpha).max(f32::MIN_POSITIVE);
        let difference = self.alpha - other.alpha;
        let rough = 1.0 + ROUGHNESS_FALL * (difference * difference / product);
        (diffuse, diffuse / rough)
    }
}

/// Weight of a neighbour so many columns or rows away in a square of `side`.
#[inline(always)]
pub fn tent(side: u32, away: i32) -> f32 {
    side as f32 - (away as f32).abs()
}

/// Sums over lights, and weighted sums of them.
#[derive(Clone, Copy, Debug, Default)]
struct Gathered {
    diffuse: Vec3,
    near: Vec3,
    grazing: Vec3,
    /// Contributions, and those that arrive.
    total: f32,
    open: f32,
}

impl Gathered {
    fn add(&mut self, sums: &SampleSums, diffuse: f32, specular: f32) {
        self.diffuse += Vec3::from_array(sums.diffuse) * diffuse;
        self.near += Vec3::from_array(sums.near) * specular;
        self.grazing += Vec3::from_array(sums.grazing) * specular;
    }

    fn add_mean(&mut self, share: &Self, diffuse: f32, specular: f32) {
        self.diffuse += share.diffuse / diffuse;
        self.near += share.near / specular;
        self.grazing += share.grazing / specular;
    }

    fn add_visibility(&mut self, sums: &SampleSums, weight: f32) {
        let total = weight * sums.total;
        self.total += total;
        self.open += total * (sums.open / sums.asked.max(1.0));
    }

    /// The share of the light that arrives.
    fn visibility(&self) -> f32 {
        if self.total > 0.0 {
            self.open / self.total
        } else {
            1.0
        }
    }
}

/// A layer at one sample: see [`Radiance`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Layers {
    /// Direct light.
    pub direct: [f32; 3],
    /// One bounce by the Lambert part.
    pub indirect_diffuse: [f32; 3],
    /// One bounce by the specular part.
    pub indirect_glossy: [f32; 3],
}

/// How far the sample of a share lies that is nearest in one direction, `0 … side − 1`; the one on the other side is `side`
/// less.
#[inline(always)]
pub fn ahead(side: u32, own: u32, share: u32) -> u32 {
    (share + side - own % side) % side
}

/// The neighbours of one sample.
struct Around<'a> {
    gbuffer: &'a GBuffer,
    radiance: &'a Radiance,
    here: Patch,
    x: u32,
    y: u32,
    /// Sums of one bounce, and of surfaces that shine.
    light: [Gathered; 2],
}

impl Around<'_> {
    /// Visits all neighbours in a square of `side` share by share; takes visibilities, or sums over lights, or both.
    fn visit(&mut self, side: u32, visibility: bool, lights: bool) {
        let mut found = 0.0f32;
        let shares = side * side;
        for share in 0..shares {
            let dx = ahead(side, self.x, share % side) as i32;
            let dy = ahead(side, self.y, share / side) as i32;
            let mut own = [Gathered::default(); 2];
            let (mut diffuse, mut specular) = (0.0f32, 0.0f32);
            for corner in 0..4 {
                let dx = dx - (corner & 1) * side as i32;
                let dy = dy - (corner >> 1) * side as i32;
                let tent = tent(side, dx) * tent(side, dy);
                let (x, y) = (self.x as i32 + dx, self.y as i32 + dy);
                let inside = x >= 0
                    && y >= 0
                    && x < self.gbuffer.width as i32
                    && y < self.gbuffer.height as i32;
                if !inside || tent <= 0.0 {
                    continue;
                }
                let at = y as usize * self.gbuffer.width as usize + x as usize;
                if self.gbuffer.triangle[at] == NO_TRIANGLE {
                    continue;
                }
                let there = Patch::of(self.gbuffer, at);
                let (alike, alike_specular) = self.here.likeness(&there);
                let weight = tent * alike;
                let weight_specular = tent * alike_specular;
                if weight_specular <= 0.0 {
                    continue;
                }
                let sums = [Some(&self.radiance.sums[at]), self.radiance.emitted.get(at)];
                for (kind, sums) in sums.into_iter().enumerate() {
                    let Some(sums) = sums else { continue };
                    if visibility {
                        self.light[kind].add_visibility(sums, weight);
                    }
                    own[kind].add(sums, weight, weight_specular);
                }
                diffuse += weight;
                specular += weight_specular;
            }
            if lights && specular > 0.0 {
                found += 1.0;
                self.light[0].add_mean(&own[0], diffuse, specular);
                self.light[1].add_mean(&own[1], diffuse, specular);
            }
        }
        if lights {
            let all = shares as f32 / found.max(1.0);
            for light in &mut self.light {
                light.diffuse *= all;
                light.near *= all;
                light.grazing *= all;
            }
        }
    }
}

/// All layers of the sample in column `x` and row `y`.
pub fn sample(
    gbuffer: &GBuffer,
    radiance: &Radiance,
    plan: &ReconstructPlan,
    x: u32,
    y: u32,
) -> Layers {
    let at = y as usize * gbuffer.width as usize + x as usize;
    if gbuffer.triangle[at] == NO_TRIANGLE {
        return Layers::default();
    }
    let mut around = Around {
        gbuffer,
        radiance,
        here: Patch::of(gbuffer, at),
        x,
        y,
        light: [Gathered::default(); 2],
    };
    let (side, filter) = (plan.interleave, plan.filter());
    if plan.sampled && side == filter {
        around.visit(side, true, true);
    } else {
        if plan.sampled {
            around.visit(filter, true, false);
        }
        around.visit(side, false, true);
    }
    let colors = Colors::of(gbuffer, at);
    let reflected = |sums: &Gathered| {
        let open = if plan.sampled { sums.visibility() } else { 1.0 };
        [
            colors.diffuse(sums.diffuse) * open,
            colors.glossy(sums.near, sums.grazing) * open,
        ]
    };
    let [diffuse, glossy] = reflected(&around.light[0]);
    let mut direct = Vec3::from_array(radiance.direct[at]);
    if plan.emitters {
        let [diffuse, glossy] = reflected(&around.light[1]);
        direct = (direct + diffuse) + glossy;
    }
    Layers {
        direct: direct.to_array(),
        indirect_diffuse: diffuse.to_array(),
        indirect_glossy: glossy.to_array(),
    }
}

/// The order of the samples that the sums were made in.
pub fn shares(gbuffer: &GBuffer, interleave: u32) -> Shares {
    Shares {
        side: interleave,
        width: gbuffer.width,
        height: gbuffer.height,
    }
}
