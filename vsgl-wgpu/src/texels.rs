//! Texels of material textures: words of an integer texture, read by exact loads.
//!
//! A storage buffer ends where a binding does, at 128 MiB by the least limits; an array of layers does not.

use crate::context::Context;
use crate::recorder::Binding;
use vsgl_core::Result;

/// Words in a row, and rows of a layer, at most.
pub(crate) const SIDE: u32 = 4096;
const LAYERS_MAX: u32 = 256;

/// Words, row by row, layer by layer.
#[derive(Debug)]
pub(crate) struct Texels {
    texture: wgpu::Texture,
    view: wgpu::TextureView,
    rows: u32,
}

impl Texels {
    pub(crate) fn bind(&self) -> Binding<'_> {
        Binding::Texture(&self.view)
    }

    /// Rows of a layer.
    pub(crate) fn rows(&self) -> u32 {
        self.rows
    }

    pub(crate) fn upload(context: &Context, words: &[u32]) -> Result<Self> {
        let rows_all = words.len().div_ceil(SIDE as usize).max(1);
        let rows = rows_all.min(SIDE as usize) as u32;
        let layers = rows_all.div_ceil(SIDE as usize) as u32;
        if layers > LAYERS_MAX {
            return Err(context.error(
                format!("the textures need {} MiB", words.len() >> 18),
                "make the textures smaller, or use `--backend cpu`",
            ));
        }
        let size = wgpu::Extent3d {
            width: SIDE,
            height: rows,
            depth_or_array_layers: layers,
        };
        let scope = context
            .device()
            .push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let texture = context.device().create_texture(&wgpu::TextureDescriptor {
            label: Some("vsgl texels"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R32Uint,
            usage: wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_DST
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(context.error(
                format!("no memory for the textures ({error})"),
                "make the textures smaller, or use `--backend cpu`",
            ));
        }
        let layer_words = SIDE as usize * rows as usize;
        for (layer, words) in words.chunks(layer_words).enumerate() {
            let whole = words.len() / SIDE as usize;
            let (full, rest) = words.split_at(whole * SIDE as usize);
            let parts = [
                (0, full, SIDE, whole as u32),
                (whole as u32, rest, rest.len() as u32, 1),
            ];
            for (row, part, width, height) in parts {
                if !part.is_empty() {
                    write(
                        context,
                        &texture,
                        (layer as u32, row),
                        part,
                        (width, height),
                    );
                }
            }
        }
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        Ok(Self {
            texture,
            view,
            rows,
        })
    }

    /// Bytes from a word on, brought to the host.
    pub(crate) fn read(&self, context: &Context, first: u64, bytes: u64) -> Result<Vec<u8>> {
        if bytes == 0 {
            return Ok(Vec::new());
        }
        let extent = self.texture.size();
        let pitch = u64::from(SIDE) * 4;
        let all = pitch * u64::from(extent.height) * u64::from(extent.depth_or_array_layers);
        let buffer = context.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some("vsgl texels"),
            size: all,
            usage: wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = context
            .device()
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(SIDE * 4),
                    rows_per_image: Some(extent.height),
                },
            },
            extent,
        );
        context.queue().submit([encoder.finish()]);
        crate::res::read(context, &buffer, first * 4, bytes)
    }
}

fn write(
    context: &Context,
    texture: &wgpu::Texture,
    (layer, row): (u32, u32),
    words: &[u32],
    (width, height): (u32, u32),
) {
    context.queue().write_texture(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: 0,
            origin: wgpu::Origin3d {
                x: 0,
                y: row,
                z: layer,
            },
            aspect: wgpu::TextureAspect::All,
        },
        bytemuck::cast_slice(words),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(width * 4),
            rows_per_image: Some(height),
        },
        wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
    );
}
