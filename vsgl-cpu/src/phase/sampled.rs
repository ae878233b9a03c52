//! A few rays from each of sixteen samples, to lights chosen by what they bring.

#![expect(
    clippy::needless_range_loop,
    reason = "one index runs over several arrays side by side"
)]

use super::block::{LANES, Sums};
use super::shade::{Origins, lanes_open};
use std::array::from_fn;
use vsgl_core::data::{SceneData, Target};
use vsgl_core::glam::Vec3;
use vsgl_core::phase::sampled::{contribution, step, threshold};
use vsgl_core::phase::shade::Colors;

/// What every light of a share brings to sixteen samples, in the order of the lights, and the sums.
#[derive(Debug, Default)]
pub(crate) struct Contributions {
    lights: Vec<[f32; LANES]>,
    pub(crate) total: [f32; LANES],
}

/// Colours of sixteen receivers, component by component.
pub(crate) struct ColorLanes {
    albedo: [[f32; LANES]; 3],
    f0: [[f32; LANES]; 3],
    f90: [f32; LANES],
}

impl ColorLanes {
    pub(crate) fn new(colors: &[Colors; LANES]) -> Self {
        Self {
            albedo: from_fn(|channel| from_fn(|lane| colors[lane].albedo[channel])),
            f0: from_fn(|channel| from_fn(|lane| colors[lane].f0[channel])),
            f90: from_fn(|lane| colors[lane].f90),
        }
    }

    /// Luminance of what the eye gets of sums over lights \[W/(m² sr)\].
    #[inline(always)]
    pub(crate) fn luminance(&self, sums: &Sums) -> [f32; LANES] {
        let mut brought = [0.0; LANES];
        for lane in 0..LANES {
            let get = |v: &[[f32; LANES]; 3]| Vec3::new(v[0][lane], v[1][lane], v[2][lane]);
            let own = Colors {
                albedo: get(&self.albedo),
                f0: get(&self.f0),
                f90: self.f90[lane],
            };
            brought[lane] = contribution(
                &own,
                get(&sums.diffuse),
                get(&sums.near),
                get(&sums.grazing),
            );
        }
        brought
    }
}

impl Contributions {
    #[inline(always)]
    pub(crate) fn add(&mut self, sums: &Sums, colors: &ColorLanes) {
        let brought = colors.luminance(sums);
        for lane in 0..LANES {
            self.total[lane] += brought[lane];
        }
        self.lights.push(brought);
    }

    /// Forgets all lights, and keeps the room.
    pub(crate) fn clear(&mut self) {
        self.lights.clear();
        self.total = [0.0; LANES];
    }
}

/// Lights drawn and lights open for each lane. `targets` gives the point of the light at a place of the share's list.
pub(crate) fn draw<'a>(
    scene: &SceneData,
    contributions: &Contributions,
    targets: impl Fn(usize) -> &'a Target,
    origins: &Origins,
    offsets: &[f32; LANES],
    rays: u32,
    masks: bool,
) -> [[f32; LANES]; 2] {
    let mut chosen = [[usize::MAX; LANES]; 64];
    let (mut asked, mut opened) = ([0u32; LANES], [0.0; LANES]);
    let steps = contributions.total.map(|total| step(total, rays));
    let mut passed = [0.0f32; LANES];
    for (light, brought) in contributions.lights.iter().enumerate() {
        for lane in 0..LANES {
            let k = &mut asked[lane];
            passed[lane] += brought[lane];
            while *k < rays && threshold(*k, offsets[lane], steps[lane]) < passed[lane] {
                chosen[*k as usize][lane] = light;
                *k += 1;
            }
        }
    }
    // Rays of one number end near each other, since samples are.
    let mut open = [0.0; LANES];
    for k in 0..rays as usize {
        let mut ends = [None; LANES];
        for lane in (0..LANES).filter(|&lane| origins.hit[lane]) {
            let light = chosen[k][lane];
            let again = k > 0 && chosen[k - 1][lane] == light;
            if light != usize::MAX && !again {
                ends[lane] = Some(targets(light));
            }
        }
        if ends.iter().any(Option::is_some) {
            let answers = lanes_open(scene, &ends, origins, masks);
            for lane in (0..LANES).filter(|&lane| ends[lane].is_some()) {
                open[lane] = answers[lane];
            }
        }
        for lane in (0..LANES).filter(|&lane| chosen[k][lane] != usize::MAX) {
            opened[lane] += open[lane];
        }
    }
    [opened, asked.map(|k| k as f32)]
}
