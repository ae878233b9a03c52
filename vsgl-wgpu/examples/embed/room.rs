//! The host's scene: a floor of brushed metal, a white wall, a red one, and a green block, under one lamp.

use vsgl_core::glam::{Vec2, Vec3};
use vsgl_core::scene::{Camera, Light, Material, Mesh, Scene, SpotLight};

/// Four corners, counter-clockwise as seen from its front, and how it reflects, in bytes as the host's textures have it.
pub(crate) struct Quad {
    pub(crate) corners: [Vec3; 4],
    pub(crate) base: [u8; 3],
    pub(crate) roughness: u8,
    pub(crate) metallic: u8,
}

impl Quad {
    pub(crate) fn normal(&self) -> Vec3 {
        let [a, b, _, d] = self.corners;
        (b - a).cross(d - a).normalize()
    }
}

/// A quad from a corner along two sides.
fn quad(corner: Vec3, u: Vec3, v: Vec3, base: [u8; 3], roughness: u8, metallic: u8) -> Quad {
    Quad {
        corners: [corner, corner + u, corner + u + v, corner + v],
        base,
        roughness,
        metallic,
    }
}

pub(crate) fn quads() -> Vec<Quad> {
    let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
    let at = Vec3::new;
    let green = [60, 180, 80];
    // The block stands at an angle.
    let (u, v, foot) = (at(0.8, 0.0, -0.3), at(0.3, 0.0, 0.8), at(0.0, 0.0, -0.9));
    let up = y * 0.9;
    let side = |corner, along| quad(corner, along, up, green, 128, 0);
    vec![
        quad(
            at(-2.0, 0.0, 2.0),
            x * 4.0,
            z * -4.0,
            [230, 220, 200],
            90,
            255,
        ),
        quad(
            at(-2.0, 0.0, -2.0),
            x * 4.0,
            y * 3.0,
            [220, 220, 220],
            255,
            0,
        ),
        quad(at(-2.0, 0.0, 2.0), z * -4.0, y * 3.0, [220, 60, 40], 255, 0),
        side(foot + v, u),
        side(foot + u + v, -v),
        side(foot + u, -u),
        side(foot, v),
        quad(foot + v + up, u, -v, green, 128, 0),
    ]
}

/// Shines from the right at the red wall and the floor before it.
pub(crate) fn lamp() -> Light {
    let position = Vec3::new(1.6, 2.4, 1.4);
    Light::Spot(SpotLight {
        position,
        axis: (Vec3::new(-1.6, 0.5, -0.2) - position).normalize(),
        intensity: [60.0, 56.0, 50.0],
        inner: 0.45,
        outer: 0.6,
        range: f32::INFINITY,
    })
}

pub(crate) fn camera() -> Camera {
    Camera::look_at(Vec3::new(1.2, 1.5, 4.2), Vec3::new(-0.2, 0.8, 0.0), 0.8)
}

/// The same for vsgl: what shadow rays need.
pub(crate) fn scene() -> Scene {
    let mut mesh = Mesh::default();
    let mut materials = Vec::new();
    for quad in quads() {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(quad.corners);
        mesh.normals.extend([quad.normal(); 4]);
        mesh.texcoords.extend([Vec2::ZERO; 4]);
        mesh.triangles.push([first, first + 1, first + 2]);
        mesh.triangles.push([first, first + 2, first + 3]);
        mesh.material.extend([materials.len() as u32; 2]);
        let part = |byte: u8| f32::from(byte) / 255.0;
        materials.push(Material {
            metallic: part(quad.metallic),
            ..Material::dielectric("", quad.base.map(part), part(quad.roughness))
        });
    }
    Scene {
        mesh,
        materials,
        lights: vec![lamp()],
        cameras: vec![("main".into(), camera())],
        ..Scene::default()
    }
}
