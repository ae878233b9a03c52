//! The rasteriser in the place of the camera's rays: it draws which triangle each sample sees, and nothing else.
//!
//! Ids may differ from those of rays along edges, since a device snaps corners to a grid of its own; where triangles are nearer
//! than the near plane; and between surfaces closer to each other than depth resolves. Of equal depths the lower id stays: WebGPU
//! draws triangles as if one after the other.

use crate::drawing::{DEPTH, DrawingId};
use crate::kernel::KernelId;
use crate::recorder::{Binding, Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use std::sync::{Arc, Mutex};
use vsgl_core::data::{GBuffer, NO_TRIANGLE, SceneData};
use vsgl_core::render::View;
use vsgl_core::{Error, Result};

/// One triangle id a sample.
const IDS: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;

/// The pipeline that draws them.
pub(crate) const ID: DrawingId = DrawingId {
    file: "entry/raster",
    color: IDS,
    adds: false,
    depth: true,
};

/// Distance of the near plane \[m\], at most. Nearer triangles are not drawn; a smaller distance would cost depth resolution.
const NEAR_MAX: f32 = 0.01;
/// Distance of the near plane in lifts of ray origins: a thousandth of the scene's diagonal.
const NEAR_LIFTS: f32 = 4096.0;

/// Twin of `Params` in `entry/raster.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    eye: [f32; 3],
    near: f32,
    right: [f32; 3],
    scale_x: f32,
    up: [f32; 3],
    scale_y: f32,
    forward: [f32; 3],
    offset_x: f32,
    offset_y: f32,
    width: u32,
    height: u32,
    padding: u32,
}

impl Params {
    /// Samples of the view as centres of texels.
    fn new(view: &View, lift: f32) -> Self {
        let camera = &view.camera;
        let (width, height) = view.samples();
        // A place `p` in pixels of the full picture is `p × density + shift` in texels.
        let density = f64::from(view.aa) / f64::from(view.stride);
        let shift = 0.5 - 0.5 / f64::from(view.stride);
        let tan_half_fov = f64::from(camera.tan_half_fov);
        let along = |pixels: u32, samples: u32| {
            let full = f64::from(view.height) * density / (tan_half_fov * f64::from(samples));
            let centre = 0.5 * f64::from(pixels) * density + shift;
            (
                full as f32,
                (2.0 * centre / f64::from(samples) - 1.0) as f32,
            )
        };
        let (scale_x, offset_x) = along(view.width, width);
        let (scale_y, offset_y) = along(view.height, height);
        Self {
            eye: camera.eye.to_array(),
            near: (NEAR_LIFTS * lift).clamp(f32::MIN_POSITIVE, NEAR_MAX),
            right: camera.right.to_array(),
            scale_x,
            up: camera.up.to_array(),
            scale_y,
            forward: camera.forward.to_array(),
            offset_x,
            // Rows count downwards.
            offset_y: -offset_y,
            width,
            height,
            padding: 0,
        }
    }
}

/// Whether samples lie on one regular grid, as a rasteriser needs it. Where pixels are left out and the others have several
/// samples they do not, and rays are taken.
pub(crate) fn fits(view: &View) -> bool {
    view.stride == 1 || view.aa == 1
}

/// The kernels beside the pipeline.
pub(crate) fn kernels() -> Vec<KernelId> {
    vec![KernelId::new("entry/raster", "ids", &[])]
}

/// Records the drawing, and its way into the column of triangles.
///
/// # Errors
/// [`Error::Setting`] if the samples do not fit into a texture of the device.
pub(crate) fn record(
    recorder: &mut Recorder<'_>,
    scene: &WgpuRes<SceneData>,
    view: &View,
    made: &WgpuRes<GBuffer>,
) -> Result<()> {
    let context = recorder.context();
    let (width, height) = view.samples();
    let most = context.device().limits().max_texture_dimension_2d;
    if width.max(height) > most {
        return Err(Error::setting(
            "primary",
            format!("{width}x{height} samples do not fit into a texture of {most}x{most}"),
            "take `--primary rays`, or a smaller picture",
        ));
    }
    let params = Params::new(view, f32::from_bits(scene.head[0]));
    let drawing = context.drawing(&ID)?;
    let targets = context.raster_targets(width, height)?;
    let nothing = wgpu::Color {
        r: f64::from(NO_TRIANGLE),
        ..wgpu::Color::TRANSPARENT
    };
    let color = wgpu::RenderPassColorAttachment {
        view: &targets.ids,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Clear(nothing),
            store: wgpu::StoreOp::Store,
        },
    };
    let depth = wgpu::RenderPassDepthStencilAttachment {
        view: &targets.depth,
        depth_ops: Some(wgpu::Operations {
            load: wgpu::LoadOp::Clear(0.0),
            store: wgpu::StoreOp::Discard,
        }),
        stencil_ops: None,
    };
    recorder.draw(
        &drawing,
        &params,
        &[("corner", scene.bind("corner"))],
        (color, Some(depth)),
        3 * scene.len("corner") as u32,
    )?;
    let ids = context.kernel("entry/raster", "ids", &[])?;
    recorder.dispatch(
        &ids,
        &params,
        &[
            ("ids_drawn", Binding::Texture(&targets.ids)),
            ("triangle_out", made.bind("triangle")),
        ],
        Groups::Items(u64::from(width) * u64::from(height)),
    )
}

/// What triangles are drawn into.
#[derive(Debug)]
pub(crate) struct Targets {
    size: (u32, u32),
    ids: wgpu::TextureView,
    depth: wgpu::TextureView,
}

/// The targets of the last size, so that a steady frame makes none.
#[derive(Debug, Default)]
pub(crate) struct TargetsKept(Mutex<Option<Arc<Targets>>>);

impl TargetsKept {
    pub(crate) fn get(
        &self,
        device: &wgpu::Device,
        width: u32,
        height: u32,
    ) -> std::result::Result<Arc<Targets>, String> {
        let mut kept = self.0.lock().expect("no panic while it is held");
        if let Some(targets) = &*kept
            && targets.size == (width, height)
        {
            return Ok(targets.clone());
        }
        let scope = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let make = |format, usage| {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some("vsgl raster"),
                size: wgpu::Extent3d {
                    width,
                    height,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let targets = Arc::new(Targets {
            size: (width, height),
            ids: make(IDS, wgpu::TextureUsages::TEXTURE_BINDING),
            depth: make(DEPTH, wgpu::TextureUsages::empty()),
        });
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(format!(
                "no memory for {width}x{height} triangle ids ({error})"
            ));
        }
        *kept = Some(targets.clone());
        Ok(targets)
    }
}

#[cfg(test)]
mod tests {
    use super::Params;
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/raster",
            "Params",
            Params {
                eye,
                near,
                right,
                scale_x,
                up,
                scale_y,
                forward,
                offset_x,
                offset_y,
                width,
                height,
                padding,
            }
        );
    }
}
