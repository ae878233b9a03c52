//! A renderer of its own that has one bounce of indirect light from vsgl.
//!
//! `cargo run --release -p vsgl-wgpu --example embed [FILE.png]`
//!
//! The host owns the device, the queue, the encoder and all textures. It draws what the camera and the lamp see by shaders of
//! its own, hands its textures over, and composes its direct light with what comes back. It draws no window, so that it runs
//! anywhere.

mod host;
mod room;
mod seen;

use std::error::Error;
use std::path::Path;
use vsgl_core::data::SceneData;
use vsgl_core::settings::Settings;
use vsgl_wgpu::interop::host_plan;
use vsgl_wgpu::{Context, WgpuOptions};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or("embed.png".into());
    let host = host::Host::new("", 320, 180, 128)?;
    let vsgl = Context::new(
        host.device.clone(),
        host.queue.clone(),
        &WgpuOptions::default(),
    )?;
    let settings = Settings {
        lights: 256,
        ..Settings::default()
    };
    let plan = host_plan(&settings, 1, true)?;
    // Compiles all shaders now, so that the first frame is no slower than others.
    vsgl.prepare(&plan)?;
    // Triangles for shadow rays. Without them the plan must have `occlusion` = `none`.
    let scene = vsgl.scene(&SceneData::new(&room::scene()))?;
    host.frame(&vsgl, Some(&scene), &plan)?;
    write_png(Path::new(&path), &host)?;
    println!(
        "{path}: {}x{}, {}",
        host.width,
        host.height,
        vsgl.info().name
    );
    Ok(())
}

fn write_png(path: &Path, host: &host::Host) -> Result<(), Box<dyn Error>> {
    let file = std::io::BufWriter::new(std::fs::File::create(path)?);
    let mut encoder = png::Encoder::new(file, host.width, host.height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.write_header()?.write_image_data(&host.picture()?)?;
    Ok(())
}
