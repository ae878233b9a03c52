//! What the host sees from one point, and what drawing it takes.

use super::room;
use vsgl_core::glam::{Mat4, Vec3};
use vsgl_wgpu::interop::{Materials, Normals, Place};
use vsgl_wgpu::wgpu;
use wgpu::TextureFormat as Format;

const DEPTH: Format = Format::Depth32Float;
const NORMAL: Format = Format::Rgba16Float;
const BASE: Format = Format::Rgba8Unorm;

/// What is seen from one point: textures that are drawn and read.
pub(crate) struct Seen {
    pub(crate) depth: wgpu::TextureView,
    pub(crate) normal: wgpu::TextureView,
    pub(crate) base: wgpu::TextureView,
    pub(crate) material: wgpu::TextureView,
    pub(crate) pipeline: wgpu::RenderPipeline,
    pub(crate) group: wgpu::BindGroup,
    /// Depth where there is nothing.
    pub(crate) background: f32,
    pub(crate) to_world: Mat4,
}

impl Seen {
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        module: &wgpu::ShaderModule,
        size: (u32, u32),
        view_projection: Mat4,
        reversed: bool,
    ) -> Self {
        let attributes =
            wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4, 3 => Unorm8x4];
        let corner = wgpu::VertexBufferLayout {
            array_stride: CORNER,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &attributes,
        };
        let compare = if reversed {
            wgpu::CompareFunction::Greater
        } else {
            wgpu::CompareFunction::Less
        };
        let pipeline = pipeline(
            device,
            module,
            ["draw_corner", "draw"],
            &[Some(corner)],
            &[NORMAL, BASE, BASE],
            Some(compare),
        );
        let bytes = view_projection.to_cols_array();
        let bytes = bytemuck::cast_slice(&bytes);
        let uniforms = filled(device, queue, wgpu::BufferUsages::UNIFORM, bytes);
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: uniforms.as_entire_binding(),
            }],
        });
        let drawn = |format| texture(device, size, format, wgpu::TextureUsages::RENDER_ATTACHMENT);
        Self {
            depth: drawn(DEPTH),
            normal: drawn(NORMAL),
            base: drawn(BASE),
            material: drawn(BASE),
            pipeline,
            group,
            background: if reversed { 0.0 } else { 1.0 },
            to_world: view_projection.inverse(),
        }
    }

    pub(crate) fn place(&self) -> Place<'_> {
        Place::Depth {
            texture: &self.depth,
            background: self.background,
        }
    }

    pub(crate) fn normals(&self) -> Normals<'_> {
        Normals {
            texture: &self.normal,
            biased: false,
        }
    }

    pub(crate) fn materials(&self) -> Materials<'_> {
        Materials::Texture {
            texture: &self.material,
            roughness_channel: 1,
            metallic_channel: 2,
        }
    }
}

/// From the world to the clip space of a view, whose depth is `a × distance + b` before the division by the distance.
pub(crate) fn projection(
    eye: Vec3,
    forward: Vec3,
    up: Vec3,
    (tan_half_fov, aspect): (f32, f32),
    (a, b): (f32, f32),
) -> Mat4 {
    let row = |v: Vec3, add: f32| v.extend(add - v.dot(eye));
    let rows = [
        row(forward.cross(up) / (tan_half_fov * aspect), 0.0),
        row(up / tan_half_fov, 0.0),
        row(forward * a, b),
        row(forward, 0.0),
    ];
    Mat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose()
}

/// Bytes of a corner.
pub(crate) const CORNER: u64 = 32;

/// Position, normal, base colour and material of each corner of each triangle.
pub(crate) fn corners() -> Vec<u8> {
    let mut bytes = Vec::new();
    for quad in room::quads() {
        for corner in [0, 1, 2, 0, 2, 3] {
            let place = quad.corners[corner].to_array();
            bytes.extend_from_slice(bytemuck::cast_slice(&place));
            bytes.extend_from_slice(bytemuck::cast_slice(&quad.normal().to_array()));
            bytes.extend(quad.base);
            bytes.extend([255, 0, quad.roughness, quad.metallic, 0]);
        }
    }
    bytes
}

pub(crate) fn filled(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    usage: wgpu::BufferUsages,
    bytes: &[u8],
) -> wgpu::Buffer {
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: bytes.len() as u64,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    queue.write_buffer(&buffer, 0, bytes);
    buffer
}

pub(crate) fn texture(
    device: &wgpu::Device,
    (width, height): (u32, u32),
    format: Format,
    usage: wgpu::TextureUsages,
) -> wgpu::TextureView {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
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
        usage: usage | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

pub(crate) fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    [vertex, fragment]: [&str; 2],
    buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
    targets: &[Format],
    depth: Option<wgpu::CompareFunction>,
) -> wgpu::RenderPipeline {
    let targets: Vec<_> = targets.iter().map(|&format| Some(format.into())).collect();
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(vertex),
            compilation_options: Default::default(),
            buffers,
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: depth.map(|compare| wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(fragment),
            compilation_options: Default::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}
