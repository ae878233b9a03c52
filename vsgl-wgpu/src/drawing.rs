//! Render pipelines: one for each file of shaders and target, made once.
//!
//! Never in strict mode: what is drawn is an id or a copy, and no arithmetic of a phase.

use crate::linked::Linked;
use std::sync::{Arc, Mutex};

/// Depth of what is drawn, the nearest the largest.
pub(crate) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// What makes a render pipeline. The entry points are called `vertex` and `fragment`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DrawingId {
    /// The file, such as `entry/raster`.
    pub(crate) file: &'static str,
    /// Format of the one target.
    pub(crate) color: wgpu::TextureFormat,
    /// Whether what is drawn is added to what is there.
    pub(crate) adds: bool,
    /// Whether the nearest is kept, by a depth of [`DEPTH`].
    pub(crate) depth: bool,
}

/// A render pipeline and the names of what it binds.
#[derive(Debug)]
pub(crate) struct Drawing {
    pub(crate) label: String,
    pub(crate) pipeline: wgpu::RenderPipeline,
    pub(crate) layout: wgpu::BindGroupLayout,
    /// Name and number of each binding.
    pub(crate) bindings: Vec<(String, u32)>,
}

/// All render pipelines made so far: a handful.
#[derive(Debug, Default)]
pub(crate) struct Drawings {
    made: Mutex<Vec<(DrawingId, Arc<Drawing>)>>,
}

impl Drawings {
    /// The pipeline, made now if it was not yet.
    pub(crate) fn get(
        &self,
        device: &wgpu::Device,
        id: &DrawingId,
    ) -> Result<Arc<Drawing>, String> {
        let mut made = self.made.lock().expect("no panic while it is held");
        if let Some((_, drawing)) = made.iter().find(|(made, _)| made == id) {
            return Ok(drawing.clone());
        }
        let drawing = Arc::new(Drawing::new(device, id)?);
        made.push((id.clone(), drawing.clone()));
        Ok(drawing)
    }
}

impl Drawing {
    fn new(device: &wgpu::Device, id: &DrawingId) -> Result<Self, String> {
        let label = format!("{} to {:?}", id.file, id.color);
        let shader = Linked::new(
            device,
            &label,
            id.file,
            &["vertex", "fragment"],
            wgpu::ShaderStages::VERTEX_FRAGMENT,
        )?;
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(&label),
            source: wgpu::ShaderSource::Wgsl(shader.source.as_str().into()),
        });
        let sum = wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::One,
            dst_factor: wgpu::BlendFactor::One,
            operation: wgpu::BlendOperation::Add,
        };
        let add = wgpu::BlendState {
            color: sum,
            alpha: sum,
        };
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(&label),
            layout: Some(&shader.pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            // Both sides of a triangle are seen.
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: id.depth.then(|| wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(true),
                // Triangles are drawn in the order of their ids, so of equal depths the lower id stays.
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format: id.color,
                    blend: id.adds.then_some(add),
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        });
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(format!("{label}: {error}"));
        }
        Ok(Self {
            label,
            pipeline,
            bindings: shader.bindings(),
            layout: shader.layout,
        })
    }
}
