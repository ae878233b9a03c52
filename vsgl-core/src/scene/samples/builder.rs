//! Shapes that the samples are put together from.

use crate::scene::{Camera, Light, Material, Scene, SpotLight};
use glam::{DVec3, Vec3};
use std::f64::consts::TAU;

/// A scene in the making. Positions are in metres, y is up.
#[derive(Default)]
pub(super) struct Builder {
    scene: Scene,
}

/// Materials of the six sides of a room.
pub(super) struct Walls {
    pub(super) floor: u32,
    pub(super) ceiling: u32,
    /// At the least z.
    pub(super) back: u32,
    /// At the greatest z.
    pub(super) front: u32,
    /// At the least x.
    pub(super) left: u32,
    /// At the greatest x.
    pub(super) right: u32,
}

/// The shape of [`Builder::pipe`].
pub(super) struct Pipe {
    /// Radii \[m\].
    pub(super) inner: f32,
    pub(super) outer: f32,
    /// \[m\]
    pub(super) height: f32,
    /// Material inside.
    pub(super) lining: u32,
    /// Material of the other sides.
    pub(super) material: u32,
}

/// The light of [`Builder::spot`].
pub(super) struct Spot {
    pub(super) position: Vec3,
    pub(super) target: Vec3,
    /// On the axis \[W/sr\].
    pub(super) intensity: [f32; 3],
    /// Half angles of the cone [degrees].
    pub(super) inner: f32,
    pub(super) outer: f32,
}

impl Builder {
    /// Adds a material, and returns its index for the shapes.
    pub(super) fn material(&mut self, material: Material) -> u32 {
        self.scene.materials.push(material);
        (self.scene.materials.len() - 1) as u32
    }

    /// A parallelogram that faces towards `u × v`.
    pub(super) fn quad(&mut self, corner: Vec3, u: Vec3, v: Vec3, material: u32) {
        let normal = u.cross(v).normalize();
        let first = self.vertices();
        for position in [corner, corner + u, corner + u + v, corner + v] {
            self.vertex(position, normal);
        }
        self.triangle([first, first + 1, first + 2], material);
        self.triangle([first, first + 2, first + 3], material);
    }

    /// The six sides of a box, seen from inside.
    pub(super) fn room(&mut self, low: Vec3, high: Vec3, walls: &Walls) {
        let d = high - low;
        let (x, y, z) = (Vec3::X * d.x, Vec3::Y * d.y, Vec3::Z * d.z);
        self.quad(low, z, x, walls.floor);
        self.quad(low + y, x, z, walls.ceiling);
        self.quad(low, x, y, walls.back);
        self.quad(low + z, y, x, walls.front);
        self.quad(low, y, z, walls.left);
        self.quad(low + x, z, y, walls.right);
    }

    /// A box seen from outside, turned about its vertical axis by `turn` [degrees], counterclockwise from above.
    pub(super) fn block(&mut self, centre: Vec3, half: Vec3, turn: f32, material: u32) {
        let (sin, cos) = f64::from(turn).to_radians().sin_cos();
        let x = Vec3::new(cos as f32, 0.0, -sin as f32) * half.x;
        let z = Vec3::new(sin as f32, 0.0, cos as f32) * half.z;
        let y = Vec3::Y * half.y;
        for (n, u, v) in [(x, y, z), (y, z, x), (z, x, y)] {
            self.quad(centre + n - u - v, u * 2.0, v * 2.0, material);
            self.quad(centre - n - u - v, v * 2.0, u * 2.0, material);
        }
    }

    /// A sphere of `segments` meridians and half as many parallels.
    pub(super) fn sphere(&mut self, centre: Vec3, radius: f32, segments: u32, material: u32) {
        let rings = segments / 2;
        let profile: Vec<Profile> = (0..=rings)
            .map(|i| {
                let (sin, cos) = (0.5 * TAU * f64::from(i) / f64::from(rings)).sin_cos();
                // The poles are exactly on the axis, so that their triangles have no area and are left out.
                let sin = if i == 0 || i == rings { 0.0 } else { sin };
                Profile {
                    radius: sin * f64::from(radius),
                    height: -cos * f64::from(radius),
                    normal: [sin, -cos],
                }
            })
            .collect();
        self.lathe(centre, &profile, segments, material);
    }

    /// An upright pipe, flat on top and bottom.
    pub(super) fn pipe(&mut self, foot: Vec3, segments: u32, pipe: &Pipe) {
        let [inner, outer, height] = [pipe.inner, pipe.outer, pipe.height].map(f64::from);
        let at = |radius, height, normal| Profile {
            radius,
            height,
            normal,
        };
        let outside = [at(outer, 0.0, [1.0, 0.0]), at(outer, height, [1.0, 0.0])];
        let top = [at(outer, height, [0.0, 1.0]), at(inner, height, [0.0, 1.0])];
        let inside = [at(inner, height, [-1.0, 0.0]), at(inner, 0.0, [-1.0, 0.0])];
        let bottom = [at(inner, 0.0, [0.0, -1.0]), at(outer, 0.0, [0.0, -1.0])];
        if inner > 0.0 {
            self.lathe(foot, &inside, segments, pipe.lining);
        }
        for side in [outside, top, bottom] {
            self.lathe(foot, &side, segments, pipe.material);
        }
    }

    /// An upright cylinder with both ends closed.
    pub(super) fn cylinder(&mut self, foot: Vec3, radius: f32, height: f32, material: u32) {
        let solid = Pipe {
            inner: 0.0,
            outer: radius,
            height,
            lining: material,
            material,
        };
        self.pipe(foot, 48, &solid);
    }

    /// A profile turned about the vertical through `foot`. Going along it, the outside is to the right.
    fn lathe(&mut self, foot: Vec3, profile: &[Profile], segments: u32, material: u32) {
        let first = self.vertices();
        for p in profile {
            for segment in 0..segments {
                let (sin, cos) = (TAU * f64::from(segment) / f64::from(segments)).sin_cos();
                let around = |r: f64, y: f64| DVec3::new(r * cos, y, -r * sin).as_vec3();
                self.vertex(
                    foot + around(p.radius, p.height),
                    around(p.normal[0], p.normal[1]),
                );
            }
        }
        for (i, pair) in profile.windows(2).enumerate() {
            for segment in 0..segments {
                let next = (segment + 1) % segments;
                let row = first + i as u32 * segments;
                let (a, b) = (row + segment, row + next);
                let (c, d) = (b + segments, a + segments);
                if pair[0].radius > 0.0 {
                    self.triangle([a, b, c], material);
                }
                if pair[1].radius > 0.0 {
                    self.triangle([a, c, d], material);
                }
            }
        }
    }

    /// Adds a spot light.
    pub(super) fn spot(&mut self, spot: Spot) {
        self.scene.lights.push(Light::Spot(SpotLight {
            position: spot.position,
            axis: (spot.target - spot.position).normalize(),
            intensity: spot.intensity,
            inner: spot.inner.to_radians(),
            outer: spot.outer.to_radians(),
            range: f32::INFINITY,
        }));
    }

    /// Adds the camera; `fov` is the vertical field of view [degrees].
    pub(super) fn camera(&mut self, eye: Vec3, target: Vec3, fov: f32) {
        let camera = Camera::look_at(eye, target, fov.to_radians());
        self.scene.cameras.push(("main".into(), camera));
    }

    /// The scene, moved so that its origin is the centre of its bounds.
    pub(super) fn finish(mut self, name: &str) -> Scene {
        let scene = &mut self.scene;
        let (low, high) = scene.bounds();
        let centre = (low + high) * 0.5;
        scene.name = name.into();
        scene.origin = centre.as_dvec3();
        for position in &mut scene.mesh.positions {
            *position -= centre;
        }
        for light in &mut scene.lights {
            match light {
                Light::Spot(spot) => spot.position -= centre,
                Light::Point(point) => point.position -= centre,
                Light::Directional(_) => {}
            }
        }
        for (_, camera) in &mut scene.cameras {
            camera.eye -= centre;
        }
        self.scene
    }

    fn vertices(&self) -> u32 {
        self.scene.mesh.positions.len() as u32
    }

    fn vertex(&mut self, position: Vec3, normal: Vec3) {
        self.scene.mesh.positions.push(position);
        self.scene.mesh.normals.push(normal);
    }

    fn triangle(&mut self, corners: [u32; 3], material: u32) {
        self.scene.mesh.triangles.push(corners);
        self.scene.mesh.material.push(material);
    }
}

/// A point of a surface of revolution.
struct Profile {
    /// Distance from the axis \[m\].
    radius: f64,
    /// Height above the foot \[m\].
    height: f64,
    /// Unit normal, away from the axis and upwards.
    normal: [f64; 2],
}
