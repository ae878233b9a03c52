//! A scene made in code whose surfaces have everything that a material can have.

use vsgl_core::glam::{Affine2, Mat2, Vec2, Vec3, Vec4};
use vsgl_core::scene::{
    Camera, DirectionalLight, Filter, Light, Material, Mesh, Scene, SpotLight, Texture, TextureRef,
    Wrap,
};

/// An image of well-mixed texels, codes from 100.
fn noise(width: u32, height: u32, seed: u32) -> Texture {
    let hash = |n: u32| {
        let n = (n ^ seed)
            .wrapping_mul(747_796_405)
            .wrapping_add(2_891_336_453);
        let n = ((n >> ((n >> 28) + 4)) ^ n).wrapping_mul(277_803_737);
        ((n >> 22) ^ n)
            .to_le_bytes()
            .map(|code| 100 + (u32::from(code) * 155 / 255) as u8)
    };
    Texture {
        width,
        height,
        texels: (0..width * height).map(hash).collect(),
    }
}

/// Normals that lean to all sides, within 45 degrees of the surface's.
fn bumps(size: u32) -> Texture {
    let mut texture = noise(size, size, 77);
    for texel in &mut texture.texels {
        let lean = |code: u8| 90 + code / 4;
        *texel = [lean(texel[0]), lean(texel[1]), 230, 255];
    }
    texture
}

/// A texture, read by all sorts of samplers: `kind` chooses.
fn used(texture: u32, kind: u32) -> TextureRef {
    let wraps = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];
    let turn = Mat2::from_angle(0.3 * kind as f32) * Mat2::from_diagonal(Vec2::new(1.5, 0.7));
    TextureRef {
        wrap: [wraps[kind as usize % 3], wraps[kind as usize / 3 % 3]],
        filter: if kind % 4 == 3 {
            Filter::Nearest
        } else {
            Filter::Linear
        },
        mips: kind % 5 != 4,
        set: kind % 2,
        transform: Affine2::from_mat2_translation(turn, Vec2::new(0.1, -0.4)),
        ..TextureRef::new(texture)
    }
}

/// Adds a quad about `centre` with edges along `right` and `up`; texture coordinates run 0..`tiles`.
fn quad(mesh: &mut Mesh, centre: Vec3, right: Vec3, up: Vec3, tiles: f32, material: u32) {
    let first = mesh.positions.len() as u32;
    let normal = right.cross(up).normalize();
    for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
        mesh.positions.push(centre + right * x + up * y);
        // Not quite flat, so that shading normals are not the geometric ones.
        mesh.normals
            .push((normal + 0.1 * (right * x + up * y).normalize()).normalize());
        let place = Vec2::new(0.5 * (x + 1.0), 0.5 * (1.0 - y));
        mesh.texcoords.push(place * tiles);
        mesh.texcoords_second.push(place * 3.0 - Vec2::splat(1.0));
        mesh.tangents.push(
            right
                .normalize()
                .extend(if x * y > 0.0 { 1.0 } else { -1.0 }),
        );
        mesh.colors.push(Vec4::new(
            0.6 + 0.4 * x,
            0.7 - 0.3 * y,
            0.8,
            0.5 + 0.5 * x * y,
        ));
    }
    mesh.triangles
        .extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    mesh.material.extend([material; 2]);
}

/// The scene: a floor whose texture is repeated `tiles` times, a back wall and a row of cards, under a spot and the sun. With `tangents` of
/// the mesh, or without.
pub fn everything(tangents: bool, tiles: f32) -> Scene {
    let base = Material {
        base_color: [0.8, 0.7, 0.6],
        metallic: 0.5,
        roughness: 0.6,
        ..Material::default()
    };
    let materials = vec![
        Material {
            base_color_texture: Some(used(0, 0)),
            metallic_roughness_texture: Some(used(1, 1)),
            normal_texture: Some(used(2, 0)),
            anisotropy: 0.7,
            anisotropy_rotation: 0.6,
            ..base.clone()
        },
        Material {
            base_color_texture: Some(used(1, 3)),
            normal_texture: Some(used(2, 5)),
            normal_scale: 2.5,
            ..base.clone()
        },
        Material {
            emission: [2.0, 1.0, 0.5],
            emissive_texture: Some(used(3, 2)),
            ..base.clone()
        },
        Material {
            emission: [0.3, 0.6, 0.9],
            double_sided: true,
            anisotropy: 1.0,
            ..base.clone()
        },
        Material {
            unlit: true,
            base_color_texture: Some(used(0, 4)),
            ..base.clone()
        },
        Material {
            metallic: 0.0,
            specular_color: [3.0, 2.0, 9.0],
            ior: 1.8,
            specular_texture: Some(used(3, 6)),
            specular_color_texture: Some(used(0, 8)),
            ..base.clone()
        },
        Material {
            metallic_roughness_texture: Some(used(1, 7)),
            anisotropy: 0.9,
            anisotropy_texture: Some(used(1, 2)),
            ..base.clone()
        },
        Material {
            base_color_texture: Some(used(1, 2)),
            alpha_cutoff: Some(0.4),
            ..base.clone()
        },
        Material {
            base_color_texture: Some(used(3, 3)),
            alpha: 0.8,
            alpha_cutoff: Some(0.2),
            ..base.clone()
        },
    ];
    let mut mesh = Mesh::default();
    let floor = Vec3::NEG_Z * 4.0;
    quad(&mut mesh, Vec3::ZERO, Vec3::X * 4.0, floor, tiles, 0);
    let back = Vec3::new(0.0, 2.0, -4.0);
    quad(&mut mesh, back, Vec3::X * 4.0, Vec3::Y * 2.0, 6.0, 6);
    for card in 0..7u32 {
        let centre = Vec3::new(card as f32 - 3.0, 1.0, -2.0 + 0.3 * (card % 3) as f32);
        // Some with their back to the camera.
        let angle = 0.7 * card as f32;
        let right = Vec3::new(angle.cos(), 0.0, angle.sin()) * 0.4;
        quad(&mut mesh, centre, right, Vec3::Y * 0.5, 2.0, 1 + card % 5);
    }
    // Holes above the floor, whose shadows have holes too, and before the camera.
    let roof = Vec3::new(-0.5, 2.2, 0.5);
    quad(&mut mesh, roof, Vec3::X, Vec3::NEG_Z, 2.0, 7);
    let screen = Vec3::new(0.8, 1.0, 2.0);
    quad(&mut mesh, screen, Vec3::X * 0.6, Vec3::Y * 0.5, 2.0, 8);
    if !tangents {
        mesh.tangents.clear();
    }
    let position = Vec3::new(-1.0, 4.5, 3.0);
    let sun = Light::Directional(DirectionalLight {
        axis: Vec3::new(0.2, -0.8, -0.4).normalize(),
        irradiance: [1.0, 1.5, 2.0],
    });
    let camera = Camera::look_at(Vec3::new(0.3, 1.1, 4.5), Vec3::new(0.0, 0.9, 0.0), 0.9);
    Scene {
        name: "everything".into(),
        mesh,
        materials,
        textures: vec![noise(13, 7, 1), noise(16, 16, 2), bumps(32), noise(5, 1, 3)],
        lights: vec![
            sun,
            Light::Spot(SpotLight {
                position,
                axis: (Vec3::NEG_Z - position).normalize(),
                intensity: [60.0, 50.0, 40.0],
                inner: 0.5,
                outer: 0.7,
                range: f32::INFINITY,
            }),
        ],
        cameras: vec![("front".into(), camera)],
        ..Scene::default()
    }
}
