//! Densities that kernels are drawn from: where they have weight, what they cost in error, and that light is worth the same
//! on its way from the lights as on its way from the eye.

use vsgl_core::backend::Backend;
use vsgl_core::data::{NO_TRIANGLE, Pdf, Rsm, SceneData};
use vsgl_core::glam::{Vec2, Vec3};
use vsgl_core::metrics::luminance;
use vsgl_core::phase::rsm::Texel;
use vsgl_core::phase::{camera_map, importance};
use vsgl_core::plan::{RsmPlan, SurfacePlan};
use vsgl_core::scene::{
    Camera, DirectionalLight, Light, Material, Mesh, PointLight, Scene, SpotLight, Texture,
    TextureRef,
};
use vsgl_core::settings::PdfMethod;
use vsgl_cpu::CpuBackend;
use vsgl_cpu::block::{LANES, Receivers, vsgl};
use vsgl_tests::measure::indirect_mape;
use vsgl_tests::render::Shot;

/// A cornell box under lights of all kinds, its lamp and walls shining too.
fn all_kinds() -> Shot {
    let mut shot = Shot::sample("cornell")
        .open()
        .with("rsm=24 clustering=filtered");
    let position = Vec3::new(0.3, 0.55, 0.2);
    shot.lights = vec![
        Light::Spot(SpotLight {
            position: Vec3::new(0.1, 0.9, 0.3),
            axis: Vec3::new(0.48, -0.6, -0.64),
            intensity: [4.0; 3],
            inner: 0.4,
            outer: 0.7,
            range: f32::INFINITY,
        }),
        Light::Point(PointLight {
            position,
            intensity: [3.0, 2.5, 2.0],
            range: f32::INFINITY,
        }),
        Light::Directional(DirectionalLight {
            axis: Vec3::new(0.2, -0.8, -0.3).normalize(),
            irradiance: [2.0, 3.0, 4.0],
        }),
    ];
    let scene = &mut shot.scene;
    let texcoord = |i: usize| Vec2::new((i % 3) as f32, (i % 5) as f32 / 4.0);
    scene.mesh.texcoords = (0..scene.mesh.positions.len()).map(texcoord).collect();
    scene.textures = vec![Texture {
        width: 2,
        height: 1,
        texels: vec![[255, 128, 0, 255], [0; 4]],
    }];
    scene.materials[0].emission = [0.5, 1.0, 2.0];
    scene.materials[1].emission = [3.0, 2.0, 1.0];
    scene.materials[1].emissive_texture = Some(TextureRef::new(0));
    shot
}

fn made(shot: &Shot, pdf: PdfMethod) -> (Rsm, Pdf) {
    let mut shot = shot.clone();
    shot.settings.pdf = pdf;
    let frame = shot.frame();
    let (rsm, pdf) = (frame.rsm.expect("maps"), frame.pdf.expect("a density"));
    (Rsm::clone(&rsm), Pdf::clone(&pdf))
}

#[test]
fn densities_add_up_keep_to_the_light_and_keep_the_floor() {
    for shot in [
        Shot::sample("cornell").with("rsm=50 clustering=filtered camera_lights=200"),
        Shot::sample("columns").with("rsm=64 clustering=filtered camera_lights=200"),
        all_kinds(),
    ] {
        for &method in PdfMethod::ALL {
            let (rsm, pdf) = made(&shot, method);
            let top = pdf.size.ilog2();
            for map in 0..pdf.maps {
                let (mut sum, mut lit) = (0.0, 0);
                for i in 0..pdf.size * pdf.size {
                    let (x, y) = (i % pdf.size, i / pdf.size);
                    let weight = pdf.at(map, 0, x, y);
                    sum += f64::from(weight);
                    let inside = x < rsm.size && y < rsm.size;
                    let texel = ((map * rsm.size + y) * rsm.size + x) as usize;
                    let flux = if inside { rsm.weight(texel) } else { 0.0 };
                    lit += u32::from(flux > 0.0);
                    let fits = match method {
                        _ if flux <= 0.0 => weight == 0.0,
                        PdfMethod::Uniform => weight == 1.0,
                        PdfMethod::Flux => weight == flux,
                        PdfMethod::Brsm => (importance::FLOOR..1e9).contains(&weight),
                    };
                    assert!(fits, "{method}: {weight} where {flux} W are reflected");
                }
                let total = f64::from(pdf.at(map, top, 0, 0));
                assert!((total - sum).abs() <= 1e-5 * sum, "{method}: {total} {sum}");
                if method == PdfMethod::Brsm && lit > 0 {
                    // One in the mean, or the floor alone where nothing of the map matters.
                    let mean = sum / f64::from(lit);
                    let floor = f64::from(importance::FLOOR);
                    let good = (mean - 1.0).abs() < 1e-4 || (mean - floor).abs() < 1e-5;
                    assert!(good, "{mean}");
                }
            }
        }
    }
}

#[test]
fn lights_are_shared_out_by_flux_whatever_the_density() {
    let shot = all_kinds().with("lights=300");
    let (rsm, flux) = made(&shot, PdfMethod::Flux);
    // Spot, six faces of the point, sun, and what shines: a pyramid each.
    assert_eq!((rsm.maps, flux.maps, flux.share.len()), (9, 9, 9));
    let totals: Vec<f64> = (0..9).map(|map| f64::from(flux.total(map))).collect();
    let all: f64 = totals.iter().sum();
    assert_eq!(flux.share.iter().sum::<u32>(), 300);
    for (&share, &total) in flux.share.iter().zip(&totals) {
        let ideal = total / all * 300.0;
        let fits = (f64::from(share) - ideal).abs() <= 1.0;
        assert!(
            fits && (share > 0) == (total > 0.0),
            "{share} lights for {ideal:.2}"
        );
    }
    for method in [PdfMethod::Uniform, PdfMethod::Brsm] {
        let (_, pdf) = made(&shot, method);
        assert_eq!(pdf.share, flux.share, "{method}");
    }
    // Kernels hold all flux of their map whatever they are drawn from: nearly, since trilinear ones overlap.
    for &method in PdfMethod::ALL {
        let mut shot = shot.clone();
        shot.settings.pdf = method;
        let vsgls = shot.frame().vsgls.expect("lights");
        assert_eq!(vsgls.kernel.len(), 300, "{method}");
        let made: f64 = vsgls
            .diffuse
            .iter()
            .map(|d| luminance(d.intensity) * std::f64::consts::PI)
            .sum();
        let sent: f64 = rsm
            .diffuse
            .iter()
            .map(|d| luminance([d[0], d[1], d[2]]))
            .sum();
        println!("{method}: {:.4} of the flux", made / sent);
        assert!((made / sent - 1.0).abs() < 0.1, "{method}: {made} {sent}");
    }
}

/// A rectangle of a mesh, its corners counterclockwise from its front.
fn quad(mesh: &mut Mesh, corners: [Vec3; 4]) {
    let [a, b, c, _] = corners;
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(corners);
    mesh.normals.extend([(b - a).cross(c - a).normalize(); 4]);
    mesh.triangles.push([first, first + 1, first + 2]);
    mesh.triangles.push([first, first + 2, first + 3]);
    mesh.material.extend([0, 0]);
}

fn of_quads(quads: &[[Vec3; 4]], camera: Camera, light: Light) -> Shot {
    let mut mesh = Mesh::default();
    for &corners in quads {
        quad(&mut mesh, corners);
    }
    let mut shot = Shot::of(Scene {
        mesh,
        materials: vec![Material::lambert("matte", [0.6; 3])],
        cameras: vec![("main".into(), camera)],
        ..Scene::default()
    });
    shot.lights = vec![light];
    shot
}

/// A horizontal square of 2 by 2 m, its front above.
fn square(x: f32, y: f32) -> [Vec3; 4] {
    [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)].map(|(a, b)| Vec3::new(x + a, y, b))
}

#[test]
fn what_cannot_light_what_is_seen_keeps_the_floor_alone() {
    // The eye sees the middle of a floor from above. Of two squares lit from below, one hangs over it and one under it; the latter shows
    // its lit side to nothing that is seen.
    let camera = Camera::look_at(Vec3::new(0.0, 1.5, 2.5), Vec3::ZERO, 0.3);
    let lamp = Light::Point(PointLight {
        position: Vec3::new(2.0, -4.0, 0.0),
        intensity: [5.0; 3],
        range: f32::INFINITY,
    });
    let shot = of_quads(
        &[square(0.0, 0.0), square(3.2, 2.0), square(0.0, -2.0)],
        camera,
        lamp,
    )
    .with("clustering=filtered rsm=64 camera_lights=256 occlusion=none");
    let (rsm, pdf) = made(&shot, PdfMethod::Brsm);
    let (mut above, mut under) = (Vec::new(), Vec::new());
    for texel in 0..rsm.position.len() {
        let (map, at) = (texel as u32 / 4096, texel as u32 % 4096);
        let weight = pdf.at(map, 0, at % 64, at / 64);
        match (rsm.triangle[texel], rsm.position[texel][1]) {
            (NO_TRIANGLE, _) => {}
            (_, y) if y > 1.0 => above.push(weight),
            (_, y) if y < -1.0 => under.push(weight),
            _ => {}
        }
    }
    assert!(
        above.len() > 50 && under.len() > 50,
        "{} {}",
        above.len(),
        under.len()
    );
    let most = under.iter().copied().fold(0.0, f32::max);
    let mean = above.iter().sum::<f32>() / above.len() as f32;
    println!("over what is seen {mean}, under it at most {most}");
    // A texel beside one that is seen takes some of what it matters; here none is beside.
    assert!(
        most < 1.01 * importance::FLOOR && mean > 5.0 * importance::FLOOR,
        "{most} {mean}"
    );
}

/// A corridor of 20 m under a sun, without a roof. The eye stands near its end and sees nothing but the last wall.
fn corridor() -> Shot {
    let at = Vec3::new;
    let (near, far) = (0.0, 20.0);
    let floor = [
        at(-1.0, 0.0, near),
        at(-1.0, 0.0, far),
        at(1.0, 0.0, far),
        at(1.0, 0.0, near),
    ];
    let wall = |x: f32| {
        let (a, b) = if x < 0.0 { (far, near) } else { (near, far) };
        [at(x, 0.0, a), at(x, 0.0, b), at(x, 2.0, b), at(x, 2.0, a)]
    };
    let end = [
        at(-1.0, 0.0, near),
        at(1.0, 0.0, near),
        at(1.0, 2.0, near),
        at(-1.0, 2.0, near),
    ];
    let camera = Camera::look_at(at(0.0, 1.2, 1.5), at(0.0, 0.8, 0.0), 0.9);
    let sun = Light::Directional(DirectionalLight {
        axis: at(0.3, -1.0, -0.1).normalize(),
        irradiance: [3.0; 3],
    });
    of_quads(&[floor, wall(-1.0), wall(1.0), end], camera, sun).with("occlusion=none rsm=128")
}

#[test]
fn lights_gather_where_they_are_seen() {
    let near = |pdf: &str| {
        let shot = corridor().with("clustering=filtered lights=256").with(pdf);
        let vsgls = shot.frame().vsgls.expect("lights");
        let near = vsgls.diffuse.iter().filter(|d| d.position[2] < 4.0).count();
        near as f64 / vsgls.diffuse.len() as f64
    };
    let [uniform, flux, brsm] = ["pdf=uniform", "pdf=flux", "pdf=brsm"].map(near);
    println!("within 4 of 20 m: uniform {uniform:.2}, flux {flux:.2}, brsm {brsm:.2}");
    assert!(uniform < 0.35 && flux < 0.35 && brsm > 0.7);
}

/// Error of kernels against every texel as a light, by density. Where all is seen flux is about as good; where little is,
/// it is not.
#[test]
fn errors_by_density() {
    let errors = |name: &str, shot: Shot| {
        let shot = shot.size(40, 22).with("occlusion=none");
        let reference = shot.clone().with("method=vpl").image();
        [
            "clustering=partition",
            "pdf=uniform",
            "pdf=flux",
            "pdf=brsm",
        ]
        .map(|choice| {
            let error = ["64", "256", "1024"].map(|lights| {
                let shot = shot.clone().with("clustering=filtered").with(choice);
                let image = shot.with(&format!("lights={lights}")).image();
                indirect_mape(&image, &reference)
            });
            println!("{name}, {choice}: {error:.2?} %");
            error
        })
    };
    errors("cornell", Shot::sample("cornell").with("rsm=96"));
    let [_, _, flux, brsm] = errors("corridor", corridor());
    for i in 0..3 {
        assert!(brsm[i] < 0.6 * flux[i], "{brsm:?} {flux:?}");
    }
}

/// What all texels matter together is what the eye gets of them in the mean of its pixels: each is the other's way back.
#[test]
fn light_is_worth_the_same_both_ways() {
    for name in ["cornell", "glossy-floor"] {
        // Square, so that the camera's map has every sample once.
        let shot = Shot::sample(name)
            .size(48, 48)
            .with("rsm=64 lights=1024 occlusion=none clustering=filtered pdf=brsm");
        let plan = shot.plan();
        let bounce = plan.bounce.as_ref().expect("a bounce");
        let density = bounce.pdf.as_ref().expect("a density");
        let asked = density.importance.as_ref().expect("importance");
        let frame = shot.clone().with("clustering=partition").frame();
        let rsm = frame.rsm.as_ref().expect("maps");

        let side = camera_map::side(48, 48);
        let map = camera_map::map(&shot.view, side);
        let texels: Vec<Texel> = (0..side * side)
            .map(|i| camera_map::texel(&frame.gbuffer, i as usize, &map))
            .collect();
        let columns = RsmPlan {
            lights: true,
            emitters: false,
            size: side,
            glossy: true,
            surface: SurfacePlan::default(),
        };
        let camera = Rsm::from_texels(side, vec![map], &texels, &columns);
        let backend = CpuBackend::new(1).expect("threads");
        let scene = backend.upload(SceneData::new(&shot.scene)).expect("room");
        let camera = backend.upload(camera).expect("room");
        let lights = backend.cluster(&scene, &camera, None, &asked.cluster);
        let lights = lights.expect("the camera's lights");

        let mut matters = 0.0;
        for first in (0..rsm.position.len()).step_by(LANES) {
            let block = std::array::from_fn(|lane| importance::receiver(rsm, first + lane));
            let receivers = Receivers::new(&block);
            let mut sums = [[Vec3::ZERO; LANES]; 3];
            for (diffuse, specular) in lights.diffuse.iter().zip(&lights.specular) {
                let sum = vsgl(diffuse, Some(specular), &receivers, &asked.shade);
                for (total, sum) in sums.iter_mut().zip([sum.diffuse, sum.near, sum.grazing]) {
                    for lane in 0..LANES {
                        total[lane] += Vec3::from_array(sum.map(|c| c[lane]));
                    }
                }
            }
            for lane in 0..LANES {
                let [diffuse, near, grazing] = sums.map(|s| s[lane]);
                let one = importance::reflected(rsm, first + lane, diffuse, near, grazing);
                matters += f64::from(one);
            }
        }
        let pixels = frame.image.indirect();
        let mean = pixels.iter().map(|&c| luminance(c)).sum::<f64>() / pixels.len() as f64;
        println!("{name}: {matters:.5} of the texels, {mean:.5} of the pixels");
        assert!(
            (matters / mean - 1.0).abs() < 0.03,
            "{name}: {matters} {mean}"
        );
    }
}

#[test]
fn densities_do_not_depend_on_the_unit_of_length_or_the_place() {
    for (scale, offset) in [
        (1e-3, Vec3::ZERO),
        (1e6, Vec3::ZERO),
        (1.0, Vec3::splat(1000.0)),
    ] {
        let settings = "rsm=32 clustering=filtered pdf=brsm camera_lights=100 lights=16";
        let here = Shot::sample("cornell").with(settings);
        let there = here.clone().placed(Default::default(), scale, offset);
        let (_, here) = made(&here, PdfMethod::Brsm);
        let (_, there) = made(&there, PdfMethod::Brsm);
        let wrong = (0..1024)
            .filter(|&i| (there.weight[i] / here.weight[i].max(1e-3) - 1.0).abs() > 0.05)
            .filter(|&i| here.weight[i] > 0.0)
            .count();
        println!("{scale} {offset}: {wrong} of 1024 differ");
        // Texels along edges may see another surface, and sets may be split elsewhere.
        assert!(wrong < 50, "{scale} {offset}: {wrong}");
    }
}
