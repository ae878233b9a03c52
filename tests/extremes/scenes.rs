//! One thing at the edge at a time.

use crate::rooms::{changed, floor, made, materials, sample, scaled, sound};
use vsgl_core::glam::{Quat, Vec3};
use vsgl_core::scene::{Camera, DirectionalLight, Light, Material, PointLight};

#[test]
fn every_sample() {
    for name in vsgl_core::scene::samples::NAMES {
        let name = name.replace(":N", ":2");
        assert!(sound(&name, &sample(&name)) > 0.0, "{name} is dark");
    }
}

#[test]
fn numbers_of_lights_and_texels() {
    for (lights, rsm) in [
        (1, 1),
        (1, 64),
        (65_536, 1),
        (65_536, 8),
        (64, 8),
        (7, 3),
        (1000, 33),
    ] {
        let shot = sample("cornell")
            .size(12, 7)
            .with(&format!("lights={lights} rsm={rsm}"));
        let indirect = sound(&format!("{lights} lights, {rsm} texels"), &shot);
        assert!(indirect > 0.0, "{lights} lights from {rsm} texels are dark");
    }
}

#[test]
fn the_most_lights_there_may_be() {
    // More texels than lights, as far as lights go.
    let shot = sample("cornell")
        .size(8, 8)
        .with("lights=65536 rsm=300 occlusion=none");
    let frame = shot.frame();
    assert_eq!(frame.vsgls.as_ref().expect("clusters").count, 65_536);
    assert_eq!(vsgl_tests::measure::fault(&frame.image), None);
}

#[test]
fn kernels_of_all_widths() {
    for kernel in [1e-3, 0.1, 4.0, 1e4] {
        let mut shot = sample("cornell");
        shot.settings.kernel = kernel;
        sound(&format!("kernel {kernel}"), &shot);
    }
}

#[test]
fn black_surfaces_reflect_nothing() {
    let shot = materials(|m| *m = Material::lambert("black", [0.0; 3]));
    assert_eq!(sound("black", &shot), 0.0);
    assert!(shot.plan().bounce.is_none());
    // Black under a varnish: the specular part alone.
    sound(
        "black varnish",
        &materials(|m| *m = Material::dielectric("black", [0.0; 3], 0.2)),
    );
    // One channel only.
    sound("red", &materials(|m| m.base_color = [1.0, 0.0, 0.0]));
}

#[test]
fn a_light_without_light() {
    let dark = changed(|shot| shot.spots().for_each(|s| s.intensity = [0.0; 3]));
    assert_eq!(sound("no intensity", &dark), 0.0);
    for intensity in [1e-30, 1e-12, 1e12] {
        let shot = changed(|shot| shot.spots().for_each(|s| s.intensity = [intensity; 3]));
        sound(&format!("intensity {intensity:e}"), &shot);
    }
}

#[test]
fn lights_in_bad_places() {
    let mesh_point = |shot: &vsgl_tests::render::Shot| shot.scene.mesh.positions[0];
    sound(
        "on a corner",
        &changed(|shot| {
            let corner = mesh_point(shot);
            shot.spots().for_each(|s| s.position = corner);
        }),
    );
    sound(
        "inside a block",
        &changed(|shot| {
            let all = &shot.scene.mesh.positions[24..48];
            let middle = all.iter().sum::<Vec3>() / all.len() as f32;
            shot.spots().for_each(|s| s.position = middle);
        }),
    );
    let floor_y = sample("cornell").scene.bounds().0.y;
    for height in [0.0, 1e-7, 1e-4] {
        sound(
            &format!("{height} above the floor"),
            &changed(|shot| {
                shot.spots().for_each(|s| {
                    s.position.y = floor_y + height;
                    s.axis = Vec3::NEG_Y;
                });
            }),
        );
    }
    let away = changed(|shot| {
        shot.spots()
            .for_each(|s| (s.position, s.axis) = (Vec3::Y * 100.0, Vec3::Y))
    });
    assert_eq!(sound("pointing to nothing", &away), 0.0);
    sound(
        "at the eye",
        &changed(|shot| {
            let eye = shot.view.camera.eye;
            shot.spots().for_each(|s| s.position = eye);
        }),
    );
}

#[test]
fn narrow_and_wide_cones() {
    for (inner, outer) in [
        (0.0, 0.01),
        (0.01, 0.01),
        (0.0, 80.0),
        (80.0, 80.0),
        (0.0, 80.1),
        (90.0, 90.0),
        (0.0, 1e-5),
    ] {
        let shot = changed(|shot| {
            shot.spots().for_each(|s| {
                s.inner = f32::to_radians(inner);
                s.outer = f32::to_radians(outer);
            });
        });
        sound(&format!("cone {inner} {outer}"), &shot);
    }
}

/// Cornell under other lights.
fn under(lights: &[Light]) -> vsgl_tests::render::Shot {
    changed(|shot| shot.lights = lights.to_vec())
}

fn point(position: Vec3, range: f32) -> Light {
    Light::Point(PointLight {
        position,
        intensity: [5.0; 3],
        range,
    })
}

fn sun(axis: Vec3) -> Light {
    Light::Directional(DirectionalLight {
        axis,
        irradiance: [5.0; 3],
    })
}

#[test]
fn points_in_bad_places() {
    let (low, high) = sample("cornell").scene.bounds();
    for (name, position) in [
        ("in the middle", 0.25 * (low + high)),
        ("in a corner", low),
        ("on the floor", Vec3::new(0.1, low.y, 0.3)),
        ("just above the floor", Vec3::new(0.1, low.y + 1e-7, 0.3)),
        ("at the eye", sample("cornell").view.camera.eye),
        ("far away", Vec3::new(1e6, 2e6, 3e6)),
    ] {
        sound(name, &under(&[point(position, f32::INFINITY)]));
    }
}

#[test]
fn ranges_of_all_sizes() {
    for range in [0.0, -1.0, f32::NAN, f32::MIN_POSITIVE, 1e-9] {
        let dark = sound(
            &format!("range {range}"),
            &under(&[point(Vec3::ZERO, range)]),
        );
        assert_eq!(dark, 0.0, "{range}");
    }
    let endless = sound("endless", &under(&[point(Vec3::ZERO, f32::INFINITY)]));
    for range in [1e3, 1e20, f32::MAX] {
        let lit = sound(
            &format!("range {range}"),
            &under(&[point(Vec3::ZERO, range)]),
        );
        assert!(
            (lit / endless - 1.0).abs() < 1e-5,
            "{range}: {lit} for {endless}"
        );
    }
    let faded = sound("range 1.5", &under(&[point(Vec3::ZERO, 1.5)]));
    assert!(faded > 0.0 && faded < 0.9 * endless, "{faded} of {endless}");
    sound(
        "a spot's range",
        &changed(|shot| shot.spots().for_each(|s| s.range = 1.0)),
    );
}

#[test]
fn surfaces_that_shine() {
    for emission in [1e-30, 1e-6, 1.0, 1e6, 1e30] {
        let shot = materials(|m| {
            m.emission = [emission; 3];
            m.double_sided = emission < 1.0;
        });
        sound(&format!("emission {emission:e}"), &shot);
        let mut alone = shot;
        alone.lights.clear();
        let bounced = sound(&format!("emission {emission:e} alone"), &alone);
        assert_eq!(bounced, 0.0, "light of emitters is direct");
    }
    let one = materials(|m| m.emission = [0.0, 3.0, 0.0]);
    for scale in [1e-3, 1e6] {
        let shot = one.clone().placed(Quat::IDENTITY, scale, Vec3::ZERO);
        sound(&format!("emission, scale {scale}"), &shot);
    }
    for (lights, rsm) in [(1, 1), (7, 3), (65_536, 8), (33, 300)] {
        let words = format!("lights={lights} rsm={rsm}");
        sound(&words, &one.clone().size(8, 5).with(&words));
    }
}

#[test]
fn suns_along_axes_and_walls() {
    for axis in [
        Vec3::X,
        Vec3::NEG_X,
        Vec3::Y,
        Vec3::NEG_Y,
        Vec3::Z,
        Vec3::NEG_Z,
        Vec3::new(1e-6, -1.0, 0.0),
        Vec3::new(0.6, -0.64, -0.48),
    ] {
        let lit = sound(&format!("sun along {axis}"), &under(&[sun(axis)]).open());
        // Only from above it shines into the room.
        assert_eq!(lit > 0.0, axis.y < -0.5, "{axis}: {lit}");
    }
    // Edge on, and onto a floor that is flat: the map has a side of no length.
    for axis in [Vec3::X, Vec3::NEG_Y] {
        let mut shot = made(
            &floor(),
            Material::lambert("floor", [0.5; 3]),
            Vec3::Y,
            Vec3::new(0.0, 1.0, 2.0),
        );
        shot.lights = vec![sun(axis)];
        sound(&format!("sun along {axis} on a floor"), &shot);
    }
}

#[test]
fn lights_of_all_kinds_in_rooms_of_all_sizes() {
    let slant = Vec3::new(0.3, -1.0, -0.2).normalize();
    let all = [point(Vec3::new(0.1, 0.3, 0.2), f32::INFINITY), sun(slant)];
    let unit = under(&all).open();
    let usual = sound("all kinds", &unit);
    assert!(usual > 0.0);
    for scale in [1e-3, 1e6] {
        let mut shot = unit.clone().placed(Quat::IDENTITY, scale, Vec3::ZERO);
        for light in &mut shot.lights {
            if let Light::Point(point) = light {
                point.intensity = point.intensity.map(|i| i * scale * scale);
            }
        }
        let found = sound(&format!("scale {scale}"), &shot);
        // The same picture but for roundings, which move a sample over an edge here and there.
        assert!(
            (found / usual - 1.0).abs() < 0.02,
            "{scale}: {found} for {usual}"
        );
    }
}

#[test]
fn cameras_in_bad_places() {
    let (low, high) = sample("cornell").scene.bounds();
    for (name, eye, target) in [
        ("on the floor", Vec3::new(0.1, low.y, 0.3), Vec3::ZERO),
        (
            "along the floor",
            Vec3::new(0.1, low.y, 0.3),
            Vec3::new(0.0, low.y, -1.0),
        ),
        ("in a corner", low, Vec3::ZERO),
        (
            "inside a block",
            Vec3::new(-0.55, low.y + 0.3, -1.0),
            Vec3::ZERO,
        ),
        ("outside", high * 3.0, Vec3::ZERO),
        ("straight down", Vec3::ZERO, Vec3::NEG_Y),
        ("far away", Vec3::new(0.0, 0.0, 1e6), Vec3::ZERO),
    ] {
        for fov in [1e-3, 1.0, 3.1] {
            let shot = sample("cornell")
                .size(16, 9)
                .seen_by(Camera::look_at(eye, target, fov));
            sound(&format!("{name}, {fov}"), &shot);
        }
    }
}

#[test]
fn roughness_at_both_ends() {
    for roughness in [0.0, 1e-3, 1.0] {
        for metallic in [0.0, 0.5, 1.0] {
            let shot = materials(|m| {
                (m.roughness, m.metallic) = (roughness, metallic);
                (m.specular, m.specular_color) = (1.0, [1.0; 3]);
            });
            sound(
                &format!("roughness {roughness}, metallic {metallic}"),
                &shot,
            );
        }
    }
}

#[test]
fn reflectances_at_both_ends() {
    for ior in [1.0, 1.5, 1e3] {
        for color in [0.0, 1.0, 1e3] {
            let shot = materials(|m| {
                (m.metallic, m.specular, m.ior) = (0.0, 1.0, ior);
                m.specular_color = [color; 3];
                m.base_color = [1.0; 3];
            });
            sound(&format!("ior {ior}, colour {color}"), &shot);
        }
    }
}

#[test]
fn receivers_inside_a_cluster() {
    // One cluster for the whole room: its mean lies in the air, its extent holds every receiver.
    sound("one cluster", &sample("caustic-ring").with("lights=1"));
    // A lit floor seen from just above: receivers on the surface of the very texels that send.
    let rough = Material::metal("rough", [1.0; 3], 0.5);
    for material in [rough, Material::lambert("matte", [1.0; 3])] {
        let shot = made(&floor(), material, Vec3::Y, Vec3::new(0.2, 0.01, 0.1));
        sound("a floor", &shot.with("lights=4"));
    }
}

#[test]
fn all_texels_at_one_point() {
    let tiny = floor().map(|t| t.map(|p| p * 1e-7));
    let shot = made(
        &tiny,
        Material::metal("dot", [1.0; 3], 0.3),
        Vec3::Y,
        Vec3::new(1e-7, 3e-7, 1e-7),
    );
    sound("a dot", &shot);
    // The light so close that all of its texels fall on one place.
    let mut near = made(
        &floor(),
        Material::dielectric("floor", [0.8; 3], 0.3),
        Vec3::Y * 1e-6,
        Vec3::new(0.0, 1.0, 0.5),
    );
    sound("a near light", &near);
    near.spots().for_each(|s| s.outer = 1e-6);
    sound("a near light of no width", &near);
}

#[test]
fn units_from_dust_to_planets() {
    for factor in [1e-6, 1e-3, 1e3, 1e6] {
        sound(&format!("times {factor:e}"), &scaled(factor));
    }
}

#[test]
fn no_triangles_and_no_lights() {
    let nothing = made(&[], Material::default(), Vec3::Y, Vec3::Z);
    assert_eq!(sound("no triangles", &nothing), 0.0);
    let dark = changed(|shot| shot.lights.clear());
    assert_eq!(sound("no lights", &dark), 0.0);
    let neither = changed(|shot| {
        shot.lights.clear();
        shot.scene.mesh = Default::default();
    });
    assert_eq!(sound("neither", &neither), 0.0);
}

#[test]
fn triangles_without_area() {
    let corner = Vec3::new(0.1, 0.0, 0.1);
    let flat = [floor()[0], [corner; 3], [Vec3::ZERO, corner, corner * 2.0]];
    sound(
        "no area",
        &made(
            &flat,
            Material::metal("", [1.0; 3], 0.4),
            Vec3::Y,
            Vec3::new(0.3, 0.5, 0.8),
        ),
    );
}

#[test]
fn normals_that_disagree_with_their_triangles() {
    let shot = changed(|shot| {
        for (i, normal) in shot.scene.mesh.normals.iter_mut().enumerate() {
            *normal = [Vec3::X, -*normal, Vec3::Y, *normal][i % 4];
        }
    });
    sound("bent normals", &shot);
}
