//! Shader functions called one by one with given arguments: for the tests that compare them with core's.

use crate::context::Context;
use crate::strict;
use std::collections::BTreeMap;
use wgpu::naga::back::spv;
use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};
use wgpu::naga::{self, ResourceBinding};
use wgpu::util::DeviceExt;

/// A shader whose entry point `main` reads numbers from binding 0 and writes numbers to binding 1, both storage.
#[derive(Debug)]
pub struct Probe {
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
}

impl Probe {
    /// Compiles it, strictly if the context is strict.
    ///
    /// # Errors
    /// What the compiler says.
    pub fn new(context: &Context, source: &str) -> Result<Self, String> {
        let device = context.device();
        let parsed = naga::front::wgsl::parse_str(source).map_err(|e| e.emit_to_string(source))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&parsed)
            .map_err(|e| e.emit_to_string(source))?;
        let entry = |binding, read_only| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("probe"),
            entries: &[entry(0, true), entry(1, false)],
        });
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let module = if context.strict() {
            let place = |binding| {
                let resource = ResourceBinding { group: 0, binding };
                let target = spv::BindingInfo {
                    descriptor_set: 0,
                    binding,
                    binding_array_size: None,
                };
                (resource, target)
            };
            let map = BTreeMap::from([place(0), place(1)]);
            strict::module(device, "probe", &parsed, &info, "main", &map)?
        } else {
            device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("probe"),
                source: wgpu::ShaderSource::Wgsl(source.into()),
            })
        };
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("probe"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("probe"),
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        match pollster::block_on(scope.pop()) {
            Some(error) => Err(error.to_string()),
            None => Ok(Self { pipeline, layout }),
        }
    }

    /// Runs so many workgroups over the arguments and brings back so many results.
    ///
    /// # Errors
    /// What the device says.
    pub fn run(
        &self,
        context: &Context,
        arguments: &[f32],
        groups: u32,
        results: usize,
    ) -> Result<Vec<f32>, String> {
        let device = context.device();
        let arguments = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("arguments"),
            contents: bytemuck::cast_slice(arguments),
            usage: wgpu::BufferUsages::STORAGE,
        });
        let size = 4 * results as u64;
        let buffer = |usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("results"),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let out = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let host = buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("probe"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: arguments.as_entire_binding(),
                },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: out.as_entire_binding(),
                },
            ],
        });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(groups, 1, 1);
        }
        encoder.copy_buffer_to_buffer(&out, 0, &host, 0, size);
        context.queue().submit([encoder.finish()]);
        host.map_async(wgpu::MapMode::Read, .., |_| {});
        context.wait().map_err(|e| e.to_string())?;
        let mapped = host.get_mapped_range(..).map_err(|e| e.to_string())?;
        Ok(bytemuck::cast_slice(&mapped).to_vec())
    }
}
