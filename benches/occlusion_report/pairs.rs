//! Pairs of a pixel and a light, by maps and by rays.

use vsgl_core::data::{GBuffer, NO_TRIANGLE, Occlusion, SceneData, Vsgls};
use vsgl_core::geom::Ray;
use vsgl_core::glam::Vec3;
use vsgl_core::phase::facing::{geometric_normal, lift};
use vsgl_core::phase::mask;
use vsgl_core::phase::occlusion::{MapFrame, open, probe};
use vsgl_core::phase::shade::{Receiver, incoming_diffuse, lambert_v13};
use vsgl_core::plan::Plan;

/// Every which pixel is asked.
const PIXELS: usize = 23;

/// Light that maps let through where rays do not, and the reverse, as shares of the light that rays let through; of the Lambert
/// part, before the colour of the receiver.
pub(crate) fn differences(
    scene: &SceneData,
    gbuffer: &GBuffer,
    vsgls: &Vsgls,
    maps: &Occlusion,
    eye: Vec3,
    plan: &Plan,
) -> [f64; 2] {
    let texels = maps.side as usize * maps.side as usize;
    let [mut all, mut leak, mut acne] = [0.0; 3];
    for sample in (0..gbuffer.triangle.len()).step_by(PIXELS) {
        let triangle = gbuffer.triangle[sample];
        if triangle == NO_TRIANGLE {
            continue;
        }
        let receiver = Receiver::of(gbuffer, sample, eye);
        let facing = geometric_normal(scene, triangle, eye - receiver.position);
        let origin = receiver.position + facing * lift(scene.lift(), receiver.position);
        for (j, (light, target)) in vsgls.diffuse.iter().zip(&vsgls.target).enumerate() {
            let arriving = incoming_diffuse(light, receiver.position, receiver.normal);
            let weight =
                f64::from((arriving.strength * lambert_v13(&arriving, &receiver)).element_sum());
            if weight <= 0.0 {
                continue;
            }
            let frame = MapFrame::new(target, scene.lift());
            let ray = Ray::new(origin, frame.centre - origin);
            let seen = f64::from(u8::from(!mask::any_hit(scene, &ray, 1.0, plan.shade.masks)));
            let at = probe(&frame, receiver.position, facing, maps.side);
            let depth = &maps.depth[j * texels..(j + 1) * texels];
            let texel = |i: u32, k: u32| {
                let (x, y) = (at.first[0] + i * at.next, at.first[1] + k * at.next);
                depth[(y * maps.side + x) as usize]
            };
            let by_map = open(&at, [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)]);
            all += weight * seen;
            leak += weight * (f64::from(by_map) - seen).max(0.0);
            acne += weight * (seen - f64::from(by_map)).max(0.0);
        }
    }
    [leak / all, acne / all]
}
