//! Pinhole cameras.

use glam::Vec3;

/// A pinhole camera with square pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Eye relative to the scene's origin \[m\].
    pub eye: Vec3,
    /// Unit direction of view.
    pub forward: Vec3,
    /// Unit direction to the right in the picture.
    pub right: Vec3,
    /// Unit direction upwards in the picture.
    pub up: Vec3,
    /// Tangent of half the vertical field of view.
    pub tan_half_fov: f32,
}

impl Camera {
    /// A camera at `eye` that looks at `target`; `fov` is the full vertical field of view \[rad\], 0 < fov < π.
    ///
    /// The picture's up is the world's +y, or +z where the view is vertical. Equal points look along -z.
    pub fn look_at(eye: Vec3, target: Vec3, fov: f32) -> Self {
        let forward = (target - eye).try_normalize().unwrap_or(Vec3::NEG_Z);
        let side = forward.cross(Vec3::Y);
        let right = if side.length_squared() > 1e-10 {
            side.normalize()
        } else {
            Vec3::X
        };
        let up = right.cross(forward);
        Self {
            eye,
            forward,
            right,
            up,
            tan_half_fov: (0.5 * fov).tan(),
        }
    }
}
