//! The camera as a light: what it sees as a reflective shadow map of its own.
//!
//! One square map, with as many texels along a side as the longer side of the picture has samples, at most
//! [`SIDE_MAX`]. Each texel takes one sample of the picture, the one nearest to its middle, and brings the same power.
//!
//! Source: Ritschel, Eisemann, Ha, Kim and Seidel 2011, "Making Imperfect Shadow Maps View-Adaptive", section 3.

use super::rsm::{FOOTPRINT_COSINE_MIN, Texel};
use crate::brdf::albedo::ggx_albedo;
use crate::data::{GBuffer, MapRecord, NO_TRIANGLE, map_kind};
use crate::math::vec::{luminance, normalize};
use crate::render::View;
use glam::Vec3;

/// Most texels along a side.
pub const SIDE_MAX: u32 = 256;

/// Texels along a side of the map of a picture of `width × height` samples.
pub fn side(width: u32, height: u32) -> u32 {
    width.max(height).clamp(1, SIDE_MAX)
}

/// The column, or the row, of the sample that a texel takes: the texel's number along its side, and samples along that
/// side of the picture.
pub fn sample(texel: u32, side: u32, samples: u32) -> u32 {
    // (2 texel + 1) samples / (2 side) in parts: the product may not fit.
    let (place, twice) = (2 * texel + 1, 2 * side);
    place * (samples / twice) + place * (samples % twice) / twice
}

/// The frame of the map: all that clusters ask of it is where its light is.
///
/// `intensity` is the flux of each texel, so that all together bring 1; `solid_angle` that of a texel on the axis, taken
/// for all: it gives clusters of few texels their extent, no more.
pub fn map(view: &View, side: u32) -> MapRecord {
    let camera = &view.camera;
    let tan = camera.tan_half_fov;
    let aspect = view.width as f32 / view.height as f32;
    let texels = (side * side) as f32;
    MapRecord {
        position: camera.eye.to_array(),
        tan_half_fov: tan,
        axis: camera.forward.to_array(),
        right: camera.right.to_array(),
        up: camera.up.to_array(),
        solid_angle: 4.0 * (tan * tan) * aspect / texels,
        intensity: [1.0 / texels; 3],
        kind: map_kind::CONE,
        cone: camera.forward.to_array(),
        cos_inner: -2.0,
        cos_outer: -3.0,
        inverse_range2: 0.0,
    }
}

/// The texel that takes a sample of the G-buffer.
pub fn texel(gbuffer: &GBuffer, sample: usize, map: &MapRecord) -> Texel {
    let triangle = gbuffer.triangle[sample];
    if triangle == NO_TRIANGLE {
        return Texel::EMPTY;
    }
    let [x, y, z, _] = gbuffer.position[sample];
    let [nx, ny, nz, f90_dielectric] = gbuffer.normal[sample];
    let [r, g, b, f0_dielectric] = gbuffer.diffuse[sample];
    let black = [0.0, 0.0, 0.0, 1.0];
    let [r0, g0, b0, alpha] = gbuffer.specular.get(sample).copied().unwrap_or(black);
    let f90 = gbuffer.grazing.get(sample).copied().unwrap_or_default();
    let tangent = gbuffer.tangent.get(sample).copied();
    let (position, normal) = (Vec3::new(x, y, z), Vec3::new(nx, ny, nz));
    let apart = Vec3::from_array(map.position) - position;
    let cosine = normal.dot(normalize(apart));
    let area = apart.dot(apart) * map.solid_angle / cosine.max(FOOTPRINT_COSINE_MIN);
    let flux = map.intensity[0];
    let f0 = Vec3::new(r0, g0, b0) * flux;
    let f90 = Vec3::splat(f90 * flux);
    // Of two roughnesses their geometric mean.
    let rough = tangent.map_or(alpha, |t| (alpha * t[3]).sqrt());
    let albedo = ggx_albedo(cosine, rough);
    Texel {
        triangle,
        position: [x, y, z, area],
        normal: [nx, ny, nz, f90_dielectric],
        diffuse: [r * flux, g * flux, b * flux, f0_dielectric],
        specular: f0.extend(alpha).to_array(),
        grazing: f90.extend(luminance(albedo.weigh(f0, f90))).to_array(),
        tangent: tangent.unwrap_or_default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_those_in_the_middle_of_texels() {
        for (side, samples) in [(1, 1), (4, 16), (256, 1920), (256, 257), (17, 5), (256, 1)] {
            for texel in 0..side {
                let exact = (f64::from(texel) + 0.5) * f64::from(samples) / f64::from(side);
                assert_eq!(
                    sample(texel, side, samples),
                    exact as u32,
                    "{texel} of {side}"
                );
            }
        }
        assert_eq!(sample(255, 256, u32::MAX >> 7), 33_488_895);
    }

    #[test]
    fn small_pictures_have_small_maps() {
        assert_eq!(side(1, 1), 1);
        assert_eq!(side(48, 27), 48);
        assert_eq!(side(1088, 1920), SIDE_MAX);
    }
}
