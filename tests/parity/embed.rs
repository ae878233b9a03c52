//! A host with its own device, encoder and textures gets the light that the backend gives for the same scene.

#[path = "../../vsgl-wgpu/examples/embed/host.rs"]
mod host;
#[path = "../../vsgl-wgpu/examples/embed/room.rs"]
mod room;

use host::Host;
use std::sync::{Mutex, MutexGuard, PoisonError};
use vsgl_core::Error;
use vsgl_core::backend::Backend;
use vsgl_core::data::{GBuffer, NO_TRIANGLE, Rsm, SceneData};
use vsgl_core::glam::Mat4;
use vsgl_core::plan::Plan;
use vsgl_core::render::{View, render};
use vsgl_core::scene::Material;
use vsgl_core::settings::Settings;
use vsgl_tests::gpu::any;
use vsgl_tests::render::Shot;
use vsgl_wgpu::interop::{
    Bounce, Colors, Export, HostGBuffer, HostMap, Materials, Normals, Place, host_plan,
};
use vsgl_wgpu::wgpu::{self, TextureFormat as Format, TextureUsages as Usages};
use vsgl_wgpu::{Context, WgpuBackend, WgpuOptions};

const SIZE: (u32, u32) = (96, 54);
const MAP: u32 = 32;

/// One host at a time; none on a machine without adapters, which is counted.
fn host() -> Option<(MutexGuard<'static, ()>, Host, WgpuBackend)> {
    static ONE: Mutex<()> = Mutex::new(());
    // Only to know whether there is any.
    drop(any(false, "embed")?);
    let one = ONE.lock().unwrap_or_else(PoisonError::into_inner);
    let host = Host::new(SIZE.0, SIZE.1, MAP).expect("an adapter");
    let context = Context::new(
        host.device.clone(),
        host.queue.clone(),
        &WgpuOptions::default(),
    );
    let backend = WgpuBackend::from(context.expect("no feature is needed"));
    Some((one, host, backend))
}

fn plan(words: &str) -> Plan {
    let mut settings = Settings {
        rsm: MAP,
        lights: 256,
        ..Settings::default()
    };
    for word in words.split_whitespace() {
        let (key, value) = word.split_once('=').expect("key=value");
        settings.set(key, value).expect(word);
    }
    host_plan(&settings, 1, true).expect("settings that go together")
}

/// The picture by the backend's own rays.
fn reference(backend: &WgpuBackend, plan: &Plan) -> Vec<[f32; 3]> {
    let scene = room::scene();
    let view = View::new(room::camera(), SIZE.0, SIZE.1).expect("a size");
    let data = backend.upload(SceneData::new(&scene)).expect("room");
    let frame = render(backend, &data, &scene.lights, &view, plan, &()).expect("a picture");
    backend
        .download(&frame.image)
        .expect("it is there")
        .indirect()
}

/// Mean difference over the mean, and the share of pixels that are off by more than a twentieth of it.
fn apart(found: &[[f32; 4]], expected: &[[f32; 3]]) -> (f64, f64) {
    assert_eq!(found.len(), expected.len());
    let sum = |rgb: &[f32]| rgb[..3].iter().map(|&c| f64::from(c)).sum::<f64>();
    let mean = expected.iter().map(|e| sum(e)).sum::<f64>() / expected.len() as f64;
    assert!(mean > 1e-3, "a dark picture: {mean}");
    let pairs = found.iter().zip(expected);
    let off: Vec<f64> = pairs.map(|(f, e)| (sum(f) - sum(e)).abs()).collect();
    let many = off.iter().filter(|&&o| o > 0.05 * mean).count();
    (
        off.iter().sum::<f64>() / (mean * off.len() as f64),
        many as f64 / off.len() as f64,
    )
}

#[test]
fn the_light_is_that_of_the_backend() {
    let Some((_one, host, backend)) = host() else {
        return;
    };
    let vsgl = backend.context();
    let scene = vsgl.scene(&SceneData::new(&room::scene())).expect("room");
    for words in [
        "occlusion=none method=vpl",
        "occlusion=none",
        "occlusion=rays",
    ] {
        let plan = plan(words);
        let scene = words.contains("rays").then_some(&scene);
        host.frame(vsgl, scene, &plan).expect("a frame");
        let indirect = host.indirect().expect("it is there");
        assert!(
            indirect
                .iter()
                .flatten()
                .all(|c| c.is_finite() && *c >= 0.0)
        );
        let (mean, many) = apart(&indirect, &reference(&backend, &plan));
        println!(
            "{words}: {:.4} % apart, {:.2} % of the pixels by much",
            100.0 * mean,
            100.0 * many
        );
        assert!(mean < LIMIT.0 && many < LIMIT.1, "{words}: {mean} {many}");
        let picture = host.picture().expect("a picture");
        let bright = picture.chunks(4).filter(|p| p[0] > 40).count();
        assert!(
            10 * bright > picture.len() / 4,
            "{bright} pixels are bright"
        );
    }
}

/// The host draws by a rasteriser, and keeps normals in 16 bits and depth by another matrix: pixels along edges show another
/// surface, texels at the borders of the map too, and where clusters differ by a texel, their light goes elsewhere a little.
const LIMIT: (f64, f64) = (0.005, 0.01);

#[test]
fn a_steady_frame_makes_no_buffer_and_no_other_picture() {
    let Some((_one, host, backend)) = host() else {
        return;
    };
    let vsgl = backend.context();
    let plan = plan("occlusion=none lights=32");
    let frame = || {
        host.frame(vsgl, None, &plan).expect("a frame");
        host.indirect().expect("it is there")
    };
    let first = frame();
    let made = vsgl.buffers_made();
    assert!(made > 0);
    for _ in 0..3 {
        assert!(frame() == first);
    }
    assert_eq!(vsgl.buffers_made(), made);
}

#[test]
fn nothing_runs_before_the_host_submits_and_frames_may_wait_together() {
    let Some((_one, host, backend)) = host() else {
        return;
    };
    let vsgl = backend.context();
    let plans = [
        plan("occlusion=none lights=32"),
        plan("occlusion=none lights=8 emission=sg"),
    ];
    let alone = plans.each_ref().map(|plan| {
        host.frame(vsgl, None, plan).expect("a frame");
        host.indirect().expect("it is there")
    });
    assert!(alone[0] != alone[1]);
    let recorded = plans.each_ref().map(|plan| {
        let mut encoder = host.device.create_command_encoder(&Default::default());
        host.record(&mut encoder, vsgl, None, plan)
            .expect("it records");
        encoder.finish()
    });
    vsgl.wait().expect("nothing to wait for");
    // What was there before.
    assert!(host.indirect().expect("it is there") == alone[1]);
    for (commands, alone) in recorded.into_iter().zip(&alone) {
        host.queue.submit([commands]);
        assert!(host.indirect().expect("it is there") == *alone);
    }
}

/// A texture with these numbers.
fn filled(host: &Host, (width, height): (u32, u32), texels: &[[f32; 4]]) -> wgpu::TextureView {
    let texture = empty(host, (width, height), Format::Rgba32Float);
    host.queue.write_texture(
        texture.texture().as_image_copy(),
        bytemuck::cast_slice(texels),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(16 * width),
            rows_per_image: None,
        },
        texture.texture().size(),
    );
    texture
}

fn empty(host: &Host, (width, height): (u32, u32), format: Format) -> wgpu::TextureView {
    let mut usage = Usages::TEXTURE_BINDING | Usages::COPY_DST | Usages::COPY_SRC;
    let wide = matches!(format, Format::Rgba16Float | Format::Rgba32Float);
    usage |= if wide {
        Usages::STORAGE_BINDING
    } else {
        Usages::empty()
    };
    let texture = host.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: usage | Usages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

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
fn map_to_world(map: &vsgl_core::data::MapRecord) -> Mat4 {
    use vsgl_core::glam::Vec3;
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
    host.frame(vsgl, None, &self::plan("occlusion=none lights=8"))
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

#[test]
fn every_way_out_brings_the_same_light() {
    let Some((_one, host, backend)) = host() else {
        return;
    };
    let vsgl = backend.context();
    let plan = plan("occlusion=none lights=16");
    let lamp = room::lamp();
    let targets = [
        Format::Rgba16Float,
        Format::Rgba16Float,
        Format::Rgba32Float,
        Format::Rgba32Float,
    ]
    .map(|format| empty(&host, SIZE, format));
    host.frame(vsgl, None, &plan).expect("a frame");
    let expected = host.indirect().expect("it is there");
    let mut encoder = host.device.create_command_encoder(&Default::default());
    let gbuffer = vsgl
        .import_gbuffer(&mut encoder, &host.gbuffer(), None, &plan)
        .expect("it records");
    let rsm = vsgl
        .import_rsm(&mut encoder, &[host.map(&lamp)], None, &plan)
        .expect("it records");
    let bounce = Bounce {
        gbuffer: &gbuffer,
        rsm: &rsm,
        scene: None,
        eye: room::camera().eye,
    };
    let radiance = vsgl
        .indirect(&mut encoder, &bounce, &plan)
        .expect("it records");
    let ways = [Export::Store, Export::Draw, Export::Store, Export::Draw];
    for (target, how) in targets.iter().zip(ways) {
        vsgl.export(&mut encoder, &radiance, target, how)
            .expect("it records");
    }
    vsgl.export(&mut encoder, &radiance, &targets[1], Export::Add)
        .expect("it records");
    // Neither another size nor a format that cannot do it.
    for (size, format, how, word) in [
        (
            (SIZE.0 + 1, SIZE.1),
            Format::Rgba32Float,
            Export::Store,
            "97x54",
        ),
        (SIZE, Format::Rgba8Unorm, Export::Store, "Rgba8Unorm"),
        (SIZE, Format::R32Uint, Export::Draw, "R32Uint"),
        (SIZE, Format::Rgba32Float, Export::Add, "Rgba32Float"),
    ] {
        let target = empty(&host, size, format);
        let refused = vsgl.export(&mut encoder, &radiance, &target, how);
        let message = refused.expect_err("it does not fit").to_string();
        assert!(message.contains(word), "{message}");
    }
    host.queue.submit([encoder.finish()]);
    for (index, factor, limit) in [
        (0, 1.0, HALF),
        (1, 2.0, 2.0 * HALF),
        (2, 1.0, 0.0),
        (3, 1.0, 0.0),
    ] {
        let bytes = if index < 2 { 8 } else { 16 };
        let found = host.read(&targets[index], bytes).expect("it is there");
        let found: Vec<f32> = match bytes {
            8 => bytemuck::pod_collect_to_vec::<u8, u16>(&found)
                .into_iter()
                .map(half)
                .collect(),
            _ => bytemuck::pod_collect_to_vec(&found),
        };
        for (f, e) in found.chunks(4).zip(&expected) {
            for (lane, e) in e.iter().take(3).enumerate() {
                assert!(
                    (f[lane] - factor * e).abs() <= limit * factor * e.max(0.01),
                    "{index}: {f:?} {e}"
                );
            }
        }
    }
}

/// A step of the numbers of 16 bits, relative: drivers may cut off what is below as well as round.
const HALF: f32 = 1.0 / 1024.0;

/// A number of 16 bits.
fn half(bits: u16) -> f32 {
    let (exponent, mantissa) = (i32::from(bits >> 10 & 31), f32::from(bits & 1023));
    let size = match exponent {
        0 => mantissa * 2f32.powi(-24),
        _ => (1024.0 + mantissa) * 2f32.powi(exponent - 25),
    };
    if bits >> 15 == 1 { -size } else { size }
}

#[test]
fn what_does_not_fit_is_refused_in_words() {
    let Some((_one, host, backend)) = host() else {
        return;
    };
    let vsgl = backend.context();
    let (with_rays, plan) = (plan("occlusion=rays"), plan("occlusion=none"));
    let refused = |error: Error, words: [&str; 2]| {
        let message = error.to_string();
        assert!(matches!(error, Error::Setting { .. }), "{message}");
        assert!(words.iter().all(|w| message.contains(w)), "{message}");
    };
    let lamp = room::lamp();
    let mut encoder = host.device.create_command_encoder(&Default::default());
    let gbuffer = vsgl
        .import_gbuffer(&mut encoder, &host.gbuffer(), None, &plan)
        .expect("it records");
    let rsm = vsgl
        .import_rsm(&mut encoder, &[host.map(&lamp)], None, &plan)
        .expect("it records");
    let bounce = Bounce {
        gbuffer: &gbuffer,
        rsm: &rsm,
        scene: None,
        eye: room::camera().eye,
    };
    let blind = vsgl.indirect(&mut encoder, &bounce, &with_rays);
    refused(
        blind.expect_err("no scene"),
        ["occlusion", "give the scene"],
    );
    let dark = host_plan(&Settings::default(), 0, true).expect("a plan");
    let unlit = vsgl.indirect(&mut encoder, &bounce, &dark);
    refused(unlit.expect_err("no bounce"), ["plan", "bounce"]);

    let mut import = |from: HostGBuffer<'_>| {
        let made = vsgl.import_gbuffer(&mut encoder, &from, None, &plan);
        made.expect_err("it does not fit")
    };
    let ids = empty(&host, SIZE, Format::R32Uint);
    let colors = HostGBuffer {
        base_color: &ids,
        ..host.gbuffer()
    };
    refused(import(colors), ["colors", "R32Uint"]);
    let small = empty(&host, (8, 8), Format::Rgba8Unorm);
    let colors = HostGBuffer {
        base_color: &small,
        ..host.gbuffer()
    };
    refused(import(colors), ["8x8", "96x54"]);
    let texture = host.gbuffer().base_color;
    let channels = HostGBuffer {
        materials: Materials::Texture {
            texture,
            roughness_channel: 1,
            metallic_channel: 4,
        },
        ..host.gbuffer()
    };
    refused(import(channels), ["materials", "channels 1 and 4"]);

    let mut import = |map: HostMap<'_>| {
        let made = vsgl.import_rsm(&mut encoder, &[map], None, &plan);
        made.expect_err("it does not fit")
    };
    let elsewhere = HostMap {
        inverse_view_projection: host.gbuffer().inverse_view_projection,
        ..host.map(&lamp)
    };
    refused(
        import(elsewhere),
        ["inverse_view_projection", "perspective"],
    );
    let flat = HostMap {
        inverse_view_projection: Mat4::IDENTITY,
        ..host.map(&lamp)
    };
    refused(import(flat), ["inverse_view_projection", "perspective"]);
    let seen = host.gbuffer();
    let wide = HostMap {
        place: seen.place,
        normals: seen.normals,
        colors: Colors::Base(seen.base_color),
        materials: seen.materials,
        ..host.map(&lamp)
    };
    refused(import(wide), ["rsm", "square"]);
}
