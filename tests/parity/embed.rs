//! A host with its own device, encoder and textures gets the light that the backend gives for the same scene.

#[path = "../../vsgl-wgpu/examples/embed/host.rs"]
mod host;
#[path = "../../vsgl-wgpu/examples/embed/room.rs"]
mod room;
#[path = "../../vsgl-wgpu/examples/embed/seen.rs"]
mod seen;

mod import;
mod refused;

use host::Host;
use std::sync::{Mutex, MutexGuard, PoisonError};
use vsgl_core::backend::Backend;
use vsgl_core::data::SceneData;
use vsgl_core::plan::Plan;
use vsgl_core::render::{View, render};
use vsgl_core::settings::Settings;
use vsgl_tests::gpu::drawing;
use vsgl_wgpu::interop::{Bounce, Export, host_plan};
use vsgl_wgpu::wgpu::{self, TextureFormat as Format, TextureUsages as Usages};
use vsgl_wgpu::{Context, WgpuBackend, WgpuOptions};

const SIZE: (u32, u32) = (96, 54);
const MAP: u32 = 32;

/// One host at a time; none on a machine without adapters, which is counted.
fn host() -> Option<(MutexGuard<'static, ()>, Host, WgpuBackend)> {
    static ONE: Mutex<()> = Mutex::new(());
    let name = drawing(false, "embedding")?.context().info().name.clone();
    let one = ONE.lock().unwrap_or_else(PoisonError::into_inner);
    let host = Host::new(&name, SIZE.0, SIZE.1, MAP).expect("the adapter was listed");
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
        "occlusion=none clustering=filtered",
        "occlusion=none clustering=whole",
        // Two draws from this density are further apart: more of them.
        "occlusion=none clustering=filtered pdf=brsm camera_lights=300 lights=1024",
        "occlusion=rays",
        "occlusion=none interleave=4",
        "occlusion=sampled interleave=2",
    ] {
        let plan = plan(words);
        let scene = (!words.contains("none")).then_some(&scene);
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
        let limit = if words.contains("filtered") || words.contains("interleave") {
            DRAWN
        } else {
            LIMIT
        };
        assert!(mean < limit.0 && many < limit.1, "{words}: {mean} {many}");
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
/// The host's map is the mirror image of ours, in which lights are drawn from other texels, and listed in another order, so that
/// pixels get other shares of them: as far as two draws are apart.
const DRAWN: (f64, f64) = (0.05, 0.25);

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
