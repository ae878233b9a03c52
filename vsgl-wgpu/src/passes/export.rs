//! One bounce, into a texture of a host.

use crate::drawing::DrawingId;
use crate::interop::Export;
use crate::kernel::KernelId;
use crate::recorder::{Binding, Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::data::Radiance;
use vsgl_core::{Error, Result};
use wgpu::TextureFormat as Format;

/// Twin of `Params` in `entry/export.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    width: u32,
    height: u32,
    columns: u32,
    most: f32,
}

/// The kernels that a host may need.
pub(crate) fn kernels() -> Vec<KernelId> {
    let kernel = |entry| KernelId::new("entry/export", entry, &[]);
    vec![kernel("store_half"), kernel("store_float")]
}

fn refused(format: Format, problem: &str, remedy: &str) -> Error {
    Error::setting("export", format!("{format:?} {problem}"), remedy)
}

/// Records the way of the radiance into the texture.
pub(crate) fn record(
    recorder: &mut Recorder<'_>,
    radiance: &WgpuRes<Radiance>,
    target: &wgpu::TextureView,
    how: Export,
) -> Result<()> {
    let context = recorder.context();
    let (width, height) = (radiance.head[0], radiance.head[1]);
    let texture = target.texture();
    let format = texture.format();
    if (texture.width(), texture.height()) != (width, height) {
        return Err(Error::setting(
            "export",
            format!(
                "a target of {}x{} for a picture of {width}x{height}",
                texture.width(),
                texture.height()
            ),
            "give both one size",
        ));
    }
    let has = |column| u32::from(radiance.len(column) > 0);
    let params = Params {
        width,
        height,
        columns: has("indirect_diffuse") + has("indirect_glossy"),
        most: match format {
            Format::Rgba16Float => 65504.0,
            Format::Rg11b10Ufloat => 64512.0,
            _ => f32::MAX,
        },
    };
    let source = ("radiance", radiance.bind("direct"));
    if how == Export::Store {
        let (entry, name) = match format {
            Format::Rgba16Float => ("store_half", "target_half"),
            Format::Rgba32Float => ("store_float", "target_float"),
            _ => {
                return Err(refused(
                    format,
                    "cannot be stored to",
                    "give Rgba16Float or Rgba32Float, or draw",
                ));
            }
        };
        let kernel = context.kernel("entry/export", entry, &[])?;
        let items = Groups::Items(u64::from(width) * u64::from(height));
        let bound = [source, (name, Binding::Texture(target))];
        return recorder.dispatch(&kernel, &params, &bound, items);
    }
    let features = format.guaranteed_format_features(context.device().features());
    let usages = features.allowed_usages;
    let floats = format.sample_type(None, Some(context.device().features()));
    if !usages.contains(wgpu::TextureUsages::RENDER_ATTACHMENT)
        || !matches!(floats, Some(wgpu::TextureSampleType::Float { .. }))
    {
        return Err(refused(
            format,
            "cannot be drawn to as floats by this device",
            "give Rgba16Float",
        ));
    }
    let adds = how == Export::Add;
    let blends = wgpu::TextureFormatFeatureFlags::BLENDABLE;
    if adds && !features.flags.contains(blends) {
        return Err(refused(
            format,
            "cannot be added to by this device",
            "give Rgba16Float, or draw into a texture of its own",
        ));
    }
    let drawing = context.drawing(&DrawingId {
        file: "entry/export",
        color: format,
        adds,
        depth: false,
    })?;
    let color = wgpu::RenderPassColorAttachment {
        view: target,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: if adds {
                wgpu::LoadOp::Load
            } else {
                wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT)
            },
            store: wgpu::StoreOp::Store,
        },
    };
    recorder.draw(&drawing, &params, &[source], (color, None), 3)
}

#[cfg(test)]
mod tests {
    use super::Params;
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/export",
            "Params",
            Params {
                width,
                height,
                columns,
                most
            }
        );
    }
}
