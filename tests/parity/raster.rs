//! The rasteriser in the place of the camera's rays: other ids along edges, few, and nothing else.

use vsgl_core::Error;
use vsgl_core::backend::Backend;
use vsgl_core::data::{GBuffer, NO_TRIANGLE, SceneData};
use vsgl_core::geom::cross;
use vsgl_core::glam::{DVec2, DVec3, Vec3};
use vsgl_core::parity::{Origin, Side, Tolerance, compare};
use vsgl_core::phase::gbuffer::ray;
use vsgl_core::render::View;
use vsgl_core::scene::samples::NAMES;
use vsgl_core::settings::Primary;
use vsgl_cpu::CpuBackend;
use vsgl_tests::gpu::drawing;
use vsgl_tests::render::Shot;
use vsgl_wgpu::WgpuBackend;

/// Share of the samples that may show another triangle.
const IDS: f64 = 5e-4;
/// Or, where edges crowd, this share of the samples within one of an edge: a device that snaps corners to a grid of 1/256 of a
/// sample moves an edge by up to half of that, which turns one sample in 512 of those beside it. Twice that.
const IDS_OF_EDGES: f64 = 1.0 / 256.0;
/// How far from an edge they may lie, in samples.
const APART: f64 = 1.0;
/// Two surfaces whose depths are nearer to each other than this share are closer than a rasteriser's depth resolves: a depth
/// is found from the corners of a triangle, in f32, where rays find it from the plane.
const DEPTH: f64 = 1e-5;

/// What both ways see.
struct Seen {
    data: SceneData,
    view: View,
    rays: GBuffer,
    raster: GBuffer,
}

fn gbuffer(backend: &WgpuBackend, data: &SceneData, shot: &Shot, primary: Primary) -> GBuffer {
    let mut plan = shot.plan().gbuffer;
    plan.primary = primary;
    let scene = backend.upload(data.clone()).expect("room");
    let made = backend.gbuffer(&scene, &shot.view, &plan).expect("it runs");
    backend.download(&made).expect("it is there")
}

fn seen(backend: &WgpuBackend, shot: &Shot) -> Seen {
    let data = SceneData::new(&shot.scene);
    Seen {
        rays: gbuffer(backend, &data, shot, Primary::Rays),
        raster: gbuffer(backend, &data, shot, Primary::Raster),
        view: shot.view,
        data,
    }
}

impl Seen {
    /// Samples that show another triangle.
    fn differing(&self) -> Vec<usize> {
        let both = self.rays.triangle.iter().zip(&self.raster.triangle);
        let differing = both.enumerate().filter(|(_, (a, b))| a != b);
        differing.map(|(i, _)| i).collect()
    }

    /// Distance of a sample from the nearest edge of a triangle as it is drawn, in samples.
    fn to_edge(&self, triangle: u32, sample: usize) -> f64 {
        let Some(corners) = self.data.corner.get(triangle as usize) else {
            return f64::INFINITY;
        };
        let (camera, width) = (&self.view.camera, self.rays.width as usize);
        let axis = |v: Vec3| v.as_dvec3();
        let in_view = |c: &[f32]| {
            let apart = DVec3::new(c[0].into(), c[1].into(), c[2].into()) - axis(camera.eye);
            let along = |v| apart.dot(axis(v));
            DVec3::new(along(camera.right), along(camera.up), along(camera.forward))
        };
        let corners: Vec<DVec3> = corners.chunks(3).map(in_view).collect();
        let drawn = clipped(&corners, near(&self.data));
        let density = f64::from(self.view.aa) / f64::from(self.view.stride);
        let shift = 0.5 - 0.5 / f64::from(self.view.stride);
        let scale = f64::from(self.view.height) / (2.0 * f64::from(camera.tan_half_fov));
        let place = |p: &DVec3| {
            let x = p.x / p.z * scale + 0.5 * f64::from(self.view.width);
            let y = 0.5 * f64::from(self.view.height) - p.y / p.z * scale;
            DVec2::new(x, y) * density + shift
        };
        let at = DVec2::new((sample % width) as f64, (sample / width) as f64) + 0.5;
        let edges = (0..drawn.len()).map(|i| {
            let (a, b) = (place(&drawn[i]), place(&drawn[(i + 1) % drawn.len()]));
            let t = (at - a).dot(b - a) / (b - a).length_squared().max(1e-30);
            at.distance(a + (b - a) * t.clamp(0.0, 1.0))
        });
        edges.fold(f64::INFINITY, f64::min)
    }

    /// Depth at which the ray of a sample crosses the plane of a triangle.
    fn depth(&self, triangle: u32, sample: usize) -> Option<f64> {
        let corners = self.data.corner.get(triangle as usize)?;
        let (x, y) = (
            sample as u32 % self.rays.width,
            sample as u32 / self.rays.width,
        );
        let ray = ray(&self.view, x, y);
        Some(cross(ray.origin, ray.direction, corners).t.into())
    }

    /// Panics unless what differs is little and explained, and nothing differs where ids agree.
    fn check(&self, name: &str) {
        let differing = self.differing();
        let all = self.rays.triangle.len();
        let at_edge = |i: &usize| self.to_edge(self.rays.triangle[*i], *i) <= APART;
        let edges = (0..all).filter(at_edge).count() as f64;
        let mut furthest = 0.0f64;
        for &sample in &differing {
            let ids = [self.rays.triangle[sample], self.raster.triangle[sample]];
            let apart = ids.map(|id| self.to_edge(id, sample));
            let depths = ids.map(|id| self.depth(id, sample));
            furthest = furthest.max(apart[0].min(apart[1]));
            let close = match depths {
                [Some(a), Some(b)] => (a - b).abs() <= DEPTH * a.max(b),
                _ => false,
            };
            assert!(
                apart[0].min(apart[1]) <= APART || close,
                "{name}: sample {sample} shows {ids:?}, {apart:?} from their edges, at depths {depths:?}"
            );
        }
        let count = differing.len() as f64;
        println!(
            "{name}: {count} ids differ, {:.4} % of all, {:.3} % of {edges} at edges, {furthest:.5} from an edge at most",
            100.0 * count / all as f64,
            100.0 * count / edges.max(1.0)
        );
        assert!(
            count <= (IDS * all as f64).max(IDS_OF_EDGES * edges),
            "{name}: {count} ids differ"
        );
        let origins = [Origin::new("wgpu", "raster"), Origin::new("wgpu", "rays")];
        let [tested, reference] = [(&origins[0], &self.raster), (&origins[1], &self.rays)]
            .map(|(origin, value)| Side { origin, value });
        let found = compare(&tested, &reference, &Tolerance::STRICT, None).expect("two ways");
        for column in &found.columns {
            assert!(
                column.name == "triangle" || column.passed,
                "{name}: {:?}",
                found.failures()
            );
        }
        let numbers = [
            &self.raster.position,
            &self.raster.normal,
            &self.raster.diffuse,
        ];
        let mut numbers = numbers
            .into_iter()
            .chain([&self.raster.specular])
            .flatten()
            .flatten();
        assert!(numbers.all(|n| n.is_finite()), "{name}: NaN or infinite");
    }
}

/// Distance of the near plane, as the documentation says: a centimetre, or a thousandth of the diagonal.
fn near(data: &SceneData) -> f64 {
    f64::from((4096.0 * data.lift()).min(0.01))
}

/// The part of a polygon beyond the near plane.
fn clipped(corners: &[DVec3], near: f64) -> Vec<DVec3> {
    let mut kept = Vec::new();
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        if a.z >= near {
            kept.push(a);
        }
        if (a.z >= near) != (b.z >= near) {
            kept.push(a.lerp(b, (near - a.z) / (b.z - a.z)));
        }
    }
    kept
}

#[test]
fn ids_differ_along_edges_alone_and_values_nowhere() {
    let Some(backend) = drawing(true, "raster") else {
        return;
    };
    for name in NAMES {
        let shot = Shot::sample(&name.replace(":N", ":2")).size(320, 180);
        seen(&backend, &shot).check(name);
    }
}

#[test]
fn samples_lie_where_those_of_rays_do() {
    let Some(backend) = drawing(true, "raster") else {
        return;
    };
    // Sizes that no number divides, several samples a pixel, and pixels left out.
    for (width, height, aa, stride) in [
        (101, 67, 3, 1),
        (331, 217, 1, 3),
        (640, 2, 1, 2),
        (1, 1, 1, 1),
    ] {
        let mut shot = Shot::sample("columns").size(width, height);
        (shot.view.aa, shot.view.stride) = (aa, stride);
        seen(&backend, &shot).check(&format!("{width}x{height}, aa {aa}, stride {stride}"));
    }
}

/// A triangle half a centimetre before the camera, which fills the picture.
fn with_a_triangle_at_the_lens() -> Shot {
    let mut shot = Shot::sample("cornell").size(64, 36);
    let camera = shot.view.camera;
    let centre = camera.eye + camera.forward * 0.005;
    let mesh = &mut shot.scene.mesh;
    let first = mesh.positions.len() as u32;
    for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (0.0, 2.0)] {
        mesh.positions
            .push(centre + (camera.right * x + camera.up * y) * 0.1);
        mesh.normals.push(-camera.forward);
        if !mesh.texcoords.is_empty() {
            mesh.texcoords.push(Default::default());
        }
    }
    mesh.triangles.push([first, first + 1, first + 2]);
    mesh.material.push(0);
    shot
}

#[test]
fn what_is_nearer_than_the_near_plane_is_not_drawn() {
    let Some(backend) = drawing(true, "raster") else {
        return;
    };
    let shot = with_a_triangle_at_the_lens();
    let seen = seen(&backend, &shot);
    let lens = seen.rays.triangle[0];
    assert!(seen.rays.triangle.iter().all(|&t| t == lens));
    assert!(
        seen.raster
            .triangle
            .iter()
            .all(|&t| t != lens && t != NO_TRIANGLE)
    );
}

#[test]
fn where_samples_lie_on_no_grid_rays_are_taken() {
    let Some(backend) = drawing(true, "raster") else {
        return;
    };
    let mut shot = with_a_triangle_at_the_lens();
    (shot.view.aa, shot.view.stride) = (2, 3);
    let seen = seen(&backend, &shot);
    assert!(seen.differing().is_empty() && seen.raster.triangle[0] != NO_TRIANGLE);
}

#[test]
fn of_equal_depths_the_lower_id_stays() {
    let Some(backend) = drawing(true, "raster") else {
        return;
    };
    let mut shot = Shot::sample("cornell").size(160, 90);
    let mesh = &mut shot.scene.mesh;
    let (triangles, material) = (mesh.triangles.clone(), mesh.material.clone());
    mesh.triangles.extend(triangles);
    mesh.material.extend(material);
    let seen = seen(&backend, &shot);
    seen.check("cornell twice");
    // Of two triangles in one place, which lie anywhere in the order, no sample shows the later one.
    let lowest = |id: u32| {
        let same = |c: &[f32; 9]| *c == seen.data.corner[id as usize];
        seen.data.corner.iter().position(same) == Some(id as usize)
    };
    let shown = seen.raster.triangle.iter().filter(|&&id| id != NO_TRIANGLE);
    assert!(shown.copied().all(lowest));
}

#[test]
fn a_scene_without_triangles_shows_none() {
    let Some(backend) = drawing(true, "raster") else {
        return;
    };
    let mut shot = Shot::sample("cornell");
    shot.scene.mesh = Default::default();
    let seen = seen(&backend, &shot);
    assert!(seen.raster.triangle.iter().all(|&id| id == NO_TRIANGLE));
    assert!(seen.differing().is_empty());
}

#[test]
fn the_cpu_and_pictures_beyond_a_texture_are_refused() {
    let mut shot = Shot::sample("cornell").with("primary=raster");
    let data = SceneData::new(&shot.scene);
    let cpu = CpuBackend::new(1).expect("threads");
    let scene = cpu.upload(data.clone()).expect("room");
    let refused = cpu.gbuffer(&scene, &shot.view, &shot.plan().gbuffer);
    let words = |e: Error| {
        assert!(
            matches!(&e, Error::Setting { name, .. } if name == "primary"),
            "{e}"
        );
        e.to_string()
    };
    assert!(words(refused.expect_err("no rasteriser")).contains("wgpu"));
    let Some(backend) = drawing(false, "raster") else {
        return;
    };
    let scene = backend.upload(data).expect("room");
    (shot.view.width, shot.view.height) = (8193, 2);
    let refused = backend.gbuffer(&scene, &shot.view, &shot.plan().gbuffer);
    assert!(words(refused.expect_err("too wide")).contains("8192"));
}
