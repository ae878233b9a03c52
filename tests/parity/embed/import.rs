//! What is imported is what a host's textures hold.

use super::{MAP, filled, host, plan, room};
use vsgl_core::backend::Backend;
use vsgl_core::data::{GBuffer, MapRecord, NO_TRIANGLE, Rsm, SceneData};
use vsgl_core::glam::{Mat4, Vec3};
use vsgl_core::scene::Material;
use vsgl_tests::render::Shot;
use vsgl_wgpu::interop::{Colors, HostGBuffer, HostMap, Materials, Normals, Place};

fn biased(normals: &[[f32; 4]]) -> Vec<[f32; 4]> {
    normals.iter().map(|n| n.map(|c| 0.5 * c + 0.5)).collect()
}

/// Relative to the largest number of an entry, which counts as `least` if it is smaller.
fn near(found: &[[f32; 4]], expected: &[[f32; 4]], lanes: usize, limit: f32, least: f32) {
    assert_eq!(found.len(), expected.len());
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        let size = e[..lanes].iter().fold(least, |m, c| m.max(c.abs()));
        for lane in 0..lanes {
            assert!(
                (f[lane] - e[lane]).abs() <= limit * size,
                "{i}: {f:?} for {e:?}"
            );
        }
    }
}

/// Textures that hold what our own phases found come back as it.
#[test]
fn what_is_imported_is_what_the_textures_hold() {
    let Some((_one, host, backend)) = host() else {
        return;
    };
    let vsgl = backend.context();
    let mut shot = Shot::sample("cornell").size(40, 24).with("rsm=16");
    for material in &mut shot.scene.materials {
        *material = Material::dielectric("", material.base_color, 0.5);
    }
    let frame = shot.frame();
    let own: &GBuffer = &frame.gbuffer;
    let (size, eye) = ((40, 24), shot.view.camera.eye);
    let place: Vec<[f32; 4]> = own
        .triangle
        .iter()
        .zip(&own.position)
        .map(|(&id, p)| [p[0], p[1], p[2], f32::from(u8::from(id != NO_TRIANGLE))])
        .collect();
    let (place, normals, colors) = (
        filled(&host, size, &place),
        filled(&host, size, &biased(&own.normal)),
        filled(&host, size, &own.diffuse),
    );
    let materials = Materials::Constant {
        roughness: 0.5,
        metallic: 0.0,
    };
    let normals = Normals {
        texture: &normals,
        biased: true,
    };
    let from = HostGBuffer {
        place: Place::Position(&place),
        normals,
        base_color: &colors,
        materials,
        inverse_view_projection: Mat4::IDENTITY,
        eye,
        dielectric_f0: own.diffuse[0][3],
    };
    let plan = shot.plan();
    let scene = vsgl.scene(&SceneData::new(&shot.scene)).expect("room");
    let mut encoder = host.device.create_command_encoder(&Default::default());
    let made = vsgl
        .import_gbuffer(&mut encoder, &from, Some(&scene), &plan)
        .expect("it records");
    host.queue.submit([encoder.finish()]);
    let found: GBuffer = backend.download(&made).expect("it is there");
    assert_eq!(found.position.len(), 40 * 24);
    // On the scene's triangles again.
    near(&found.position, &own.position, 3, 1e-5, 1.0);
    // They were stored as 0 ..= 1 and rounded for it.
    near(&found.normal, &own.normal, 3, 1e-6, 1e-6);
    near(&found.diffuse, &own.diffuse, 4, 0.0, 1e-6);
    near(&found.specular, &own.specular, 4, 1e-6, 1e-6);
    // Where shadow rays start: the same triangle, or its neighbour along an edge.
    let others = found
        .triangle
        .iter()
        .zip(&own.triangle)
        .filter(|(a, b)| a != b)
        .count();
    assert!(others <= 4, "{others} of 960 triangles differ");

    // Flux as it is stored; the same solid angles would need the same matrix.
    let own: &Rsm = frame.rsm.as_ref().expect("maps");
    let size = (16, 16);
    let place: Vec<[f32; 4]> = own
        .triangle
        .iter()
        .zip(&own.position)
        .map(|(&id, p)| [p[0], p[1], p[2], f32::from(u8::from(id != NO_TRIANGLE))])
        .collect();
    let (place, normals, colors) = (
        filled(&host, size, &place),
        filled(&host, size, &own.normal),
        filled(&host, size, &own.diffuse),
    );
    let map = HostMap {
        light: &shot.lights[0],
        place: Place::Position(&place),
        normals: Normals {
            texture: &normals,
            biased: false,
        },
        colors: Colors::Flux(&colors),
        materials,
        inverse_view_projection: map_to_world(&own.map[0]),
        dielectric_f0: own.diffuse[0][3],
    };
    let mut encoder = host.device.create_command_encoder(&Default::default());
    let made = vsgl
        .import_rsm(&mut encoder, &[map], Some(&scene), &plan)
        .expect("it records");
    host.queue.submit([encoder.finish()]);
    let found: Rsm = backend.download(&made).expect("it is there");
    assert!(found.map == own.map);
    near(&found.diffuse, &own.diffuse, 3, 0.0, 1e-6);
    near(&found.normal, &own.normal, 3, 1e-6, 1e-6);
    // The area of a texel's footprint too: solid angle and cosine by another way.
    near(&found.position, &own.position, 3, 1e-5, 1.0);
    let areas = |position: &[[f32; 4]]| position.iter().map(|p| [p[3]; 4]).collect::<Vec<_>>();
    near(
        &areas(&found.position),
        &areas(&own.position),
        1,
        1e-4,
        1e-6,
    );
}

/// From the clip space of a map as our own phase draws it to the world.
fn map_to_world(map: &MapRecord) -> Mat4 {
    let side = |v: [f32; 3]| (Vec3::from_array(v) * map.tan_half_fov).extend(0.0);
    // A clip depth of 1 − 1/t at the distance t along the axis.
    let axis = Vec3::from_array(map.axis);
    let eye = Vec3::from_array(map.position);
    Mat4::from_cols(
        side(map.right),
        side(map.up),
        (-eye).extend(-1.0),
        (axis + eye).extend(1.0),
    )
}

#[test]
fn maps_of_base_colours_are_those_of_our_own_rays() {
    let Some((_one, host, backend)) = host() else {
        return;
    };
    let vsgl = backend.context();
    let plan = plan("");
    host.frame(vsgl, None, &super::plan("occlusion=none lights=8"))
        .expect("a frame");
    let lamp = room::lamp();
    let scene = vsgl.scene(&SceneData::new(&room::scene())).expect("room");
    let mut encoder = host.device.create_command_encoder(&Default::default());
    let imported = vsgl.import_rsm(&mut encoder, &[host.map(&lamp)], Some(&scene), &plan);
    let traced = vsgl.trace_rsm(&mut encoder, &scene, &[lamp], &plan);
    host.queue.submit([encoder.finish()]);
    let [found, own]: [Rsm; 2] = [imported, traced].map(|made| {
        backend
            .download(&made.expect("it records"))
            .expect("it is there")
    });
    assert_eq!((found.size, found.maps), (own.size, own.maps));
    // The host's map is the mirror image of ours: its columns run the other way.
    let mirrored = |i: usize| i + MAP as usize - 1 - 2 * (i % MAP as usize);
    let same: Vec<usize> = (0..own.triangle.len())
        .filter(|&i| own.triangle[i] != NO_TRIANGLE)
        .filter(|&i| found.triangle[mirrored(i)] == own.triangle[i])
        .collect();
    let lit = own.triangle.iter().filter(|&&id| id != NO_TRIANGLE).count();
    assert!(
        lit > 500 && same.len() * 100 > lit * 98,
        "{} of {lit}",
        same.len()
    );
    let pick = |column: &[[f32; 4]]| same.iter().map(|&i| column[i]).collect::<Vec<_>>();
    let pick_found = |column: &[[f32; 4]]| {
        same.iter()
            .map(|&i| column[mirrored(i)])
            .collect::<Vec<_>>()
    };
    // Normals of 11 bits, depth and directions by the inverse of a matrix in f32, 1e-5 off, which the cone's falloff takes
    // many times; flux as against a thousandth of a watt, since at the cone's border it is nothing.
    near(
        &pick_found(&found.position),
        &pick(&own.position),
        3,
        1e-4,
        1.0,
    );
    near(
        &pick_found(&found.normal),
        &pick(&own.normal),
        3,
        1e-3,
        1e-6,
    );
    near(
        &pick_found(&found.diffuse),
        &pick(&own.diffuse),
        3,
        5e-4,
        1e-3,
    );
    near(
        &pick_found(&found.specular),
        &pick(&own.specular),
        4,
        5e-4,
        1e-3,
    );
    near(
        &pick_found(&found.grazing),
        &pick(&own.grazing),
        4,
        2e-3,
        1e-3,
    );
}
