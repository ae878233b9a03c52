//! Rays to lights that are chosen by what they bring, after shading has left the sums.

use super::flag;
use super::shade::{self, LIGHTS_SOFTWARE, ROUNDS_SOFTWARE, form_constants, rays_in};
use crate::context::Context;
use crate::kernel::{Kernel, KernelId};
use crate::recorder::{Binding, Groups, Recorder};
use bytemuck::{Pod, Zeroable};
use std::sync::Arc;
use vsgl_core::Result;
use vsgl_core::plan::ShadePlan;
use vsgl_core::settings::Settings;

/// Rays of a sample in one dispatch on a software driver, at least: one may take eight thousand rounds, see `passes/shade.rs`.
const RAYS_SOFTWARE: u64 = 4;

/// Twin of `Params` in `entry/sampled.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    eye: [f32; 3],
    lift: f32,
    count: u32,
    first: u32,
    end: u32,
    nodes: u32,
    lights: u32,
    first_light: u32,
    end_light: u32,
    width: u32,
    height: u32,
    side: u32,
    rays: u32,
    first_ray: u32,
    end_ray: u32,
    emitted: u32,
    padding: [u32; 2],
}

/// The kernel and what it runs over.
#[derive(Debug)]
pub(super) struct Sampled {
    kernel: Arc<Kernel>,
    rays: u32,
    emitters: bool,
    /// Rays, and lights of a share, in one dispatch.
    groups: [u32; 2],
}

/// The pipeline that a plan needs.
pub(super) fn kernel(plan: &ShadePlan) -> KernelId {
    let mut constants = form_constants(plan).to_vec();
    constants.extend([
        ("EMITTERS", flag(plan.emitters)),
        ("MASKS", flag(plan.masks)),
    ]);
    KernelId::new("entry/sampled", "sampled", &constants)
}

impl Sampled {
    pub(super) fn new(
        context: &Context,
        nodes: u64,
        plan: &ShadePlan,
        software: bool,
    ) -> Result<Self> {
        let id = kernel(plan);
        // Twice so many rounds as lights are for the lights and their thresholds.
        let rounds = ROUNDS_SOFTWARE - 2 * u64::from(LIGHTS_SOFTWARE);
        let most = u64::from(Settings::RAYS_MAX);
        let rays = rays_in(rounds, nodes).clamp(RAYS_SOFTWARE, most) as u32;
        Ok(Self {
            kernel: context.kernel(id.file, id.entry, &id.constants)?,
            rays: plan.rays,
            emitters: plan.emitters,
            groups: if software {
                [rays, LIGHTS_SOFTWARE]
            } else {
                [u32::MAX; 2]
            },
        })
    }

    /// Records the rays of a band, whose sums are there.
    pub(super) fn record(
        &self,
        recorder: &mut Recorder<'_>,
        of: &shade::Params,
        bound: &[(&str, Binding<'_>)],
        indices: Groups<'_>,
    ) -> Result<()> {
        let [rays, lights] = self.groups;
        let lights = lights.saturating_mul(of.side * of.side);
        for emitted in 0..=u32::from(self.emitters) {
            for first_ray in (0..self.rays).step_by(rays as usize) {
                // One group at least, which says how many rays there are.
                for group in 0..of.lights.div_ceil(lights).max(1) {
                    let params = Params {
                        eye: of.eye,
                        lift: of.lift,
                        count: of.count,
                        first: of.first,
                        end: of.end,
                        nodes: of.nodes,
                        lights: of.lights,
                        first_light: group * lights,
                        end_light: (group + 1).saturating_mul(lights).min(of.lights),
                        width: of.width,
                        height: of.height,
                        side: of.side,
                        rays: self.rays,
                        first_ray,
                        end_ray: self.rays.min(first_ray.saturating_add(rays)),
                        emitted,
                        padding: [0; 2],
                    };
                    recorder.dispatch(&self.kernel, &params, bound, indices)?;
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Params;
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/sampled",
            "Params",
            Params {
                eye,
                lift,
                count,
                first,
                end,
                nodes,
                lights,
                first_light,
                end_light,
                width,
                height,
                side,
                rays,
                first_ray,
                end_ray,
                emitted,
                padding
            }
        );
    }
}
