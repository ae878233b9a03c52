//! What does not fit is refused before anything is recorded.

use super::{SIZE, empty, host, plan, room};
use vsgl_core::Error;
use vsgl_core::glam::Mat4;
use vsgl_core::settings::Settings;
use vsgl_wgpu::interop::{Bounce, Colors, HostGBuffer, HostMap, Materials, host_plan};
use vsgl_wgpu::wgpu::TextureFormat as Format;

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
