//! Dispatches and drawings, recorded one after the other. Dispatches in a row share one compute pass.

use crate::context::Context;
use crate::drawing::Drawing;
use crate::kernel::{INVOCATIONS, Kernel};
use std::sync::atomic::{AtomicU64, Ordering};
use vsgl_core::Result;
use vsgl_core::render::Phase;

/// Bytes of one set of parameters, which is also the least alignment that WebGPU promises.
const SLOT: u64 = 256;
/// Sets of parameters before the first is written over: a host may have as many dispatches recorded and not submitted.
const SLOTS: u64 = 1 << 14;

/// Parameters of dispatches, a ring.
#[derive(Debug)]
pub(crate) struct Uniforms {
    buffer: wgpu::Buffer,
    next: AtomicU64,
}

impl Uniforms {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        Self {
            buffer: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("vsgl parameters"),
                size: SLOT * SLOTS,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            next: AtomicU64::new(0),
        }
    }

    /// Where the parameters of a dispatch lie, once they are written there.
    fn write(&self, queue: &wgpu::Queue, bytes: &[u8]) -> wgpu::BufferBinding<'_> {
        debug_assert!(bytes.len() as u64 <= SLOT, "parameters of one dispatch");
        let offset = self.next.fetch_add(1, Ordering::Relaxed) % SLOTS * SLOT;
        queue.write_buffer(&self.buffer, offset, bytes);
        wgpu::BufferBinding {
            buffer: &self.buffer,
            offset,
            size: wgpu::BufferSize::new(SLOT),
        }
    }
}

/// What a name of a shader is bound to.
#[derive(Clone, Debug)]
pub(crate) enum Binding<'a> {
    /// A whole buffer.
    Buffer(&'a wgpu::Buffer),
    /// A texture.
    Texture(&'a wgpu::TextureView),
}

/// How many workgroups run.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Groups<'a> {
    /// One invocation an item, in workgroups of [`INVOCATIONS`]. `item_index` in `data/index.wgsl` gives an invocation its
    /// item.
    Items(u64),
    /// So many workgroups; `group_index` in `data/index.wgsl` gives a workgroup its number.
    Count(u64),
    /// As three integers in a buffer say, from a byte offset on.
    Indirect(&'a wgpu::Buffer, u64),
}

/// Workgroups along a dimension, at most, by the limits of WebGPU.
const ALONG_MAX: u64 = 65_535;

/// So many workgroups as a grid that the limits allow.
fn grid(groups: u64) -> [u32; 3] {
    let groups = groups.max(1);
    let rows = groups.div_ceil(ALONG_MAX);
    [groups.div_ceil(rows) as u32, rows as u32, 1]
}

/// Records dispatches and drawings.
pub(crate) struct Recorder<'a> {
    context: &'a Context,
    encoder: &'a mut wgpu::CommandEncoder,
    phase: Phase,
    /// The compute pass of the last dispatches, until something is drawn.
    pass: Option<wgpu::ComputePass<'static>>,
}

impl<'a> Recorder<'a> {
    /// Records into a host's encoder, under a phase's name.
    pub(crate) fn new(
        context: &'a Context,
        encoder: &'a mut wgpu::CommandEncoder,
        phase: Phase,
    ) -> Self {
        Self {
            context,
            encoder,
            phase,
            pass: None,
        }
    }

    pub(crate) fn context(&self) -> &'a Context {
        self.context
    }

    /// Runs a kernel. Names that its entry point does not use may be given all the same.
    pub(crate) fn dispatch<P: bytemuck::Pod>(
        &mut self,
        kernel: &Kernel,
        params: &P,
        bound: &[(&str, Binding<'_>)],
        groups: Groups<'_>,
    ) -> Result<()> {
        let group = self.group(
            &kernel.label,
            &kernel.layout,
            &kernel.bindings,
            params,
            bound,
        )?;
        let (context, phase, encoder) = (self.context, self.phase, &mut *self.encoder);
        let pass = self.pass.get_or_insert_with(|| {
            let timestamps = context.timer().and_then(|timer| timer.begin(phase));
            let descriptor = wgpu::ComputePassDescriptor {
                label: Some(&format!("vsgl {phase}")),
                timestamp_writes: timestamps.as_ref().map(|t| t.writes()),
            };
            encoder.begin_compute_pass(&descriptor).forget_lifetime()
        });
        pass.set_pipeline(&kernel.pipeline);
        pass.set_bind_group(0, &group, &[]);
        let [x, y, z] = match groups {
            Groups::Items(items) => grid(items.div_ceil(u64::from(INVOCATIONS))),
            Groups::Count(count) => grid(count),
            Groups::Indirect(buffer, offset) => {
                pass.dispatch_workgroups_indirect(buffer, offset);
                return Ok(());
            }
        };
        pass.dispatch_workgroups(x, y, z);
        Ok(())
    }

    /// Draws so many vertices, which the shader pulls from what it binds, in a render pass of its own.
    pub(crate) fn draw<P: bytemuck::Pod>(
        &mut self,
        drawing: &Drawing,
        params: &P,
        bound: &[(&str, Binding<'_>)],
        attachments: (
            wgpu::RenderPassColorAttachment<'_>,
            Option<wgpu::RenderPassDepthStencilAttachment<'_>>,
        ),
        vertices: u32,
    ) -> Result<()> {
        let bindings = &drawing.bindings;
        let group = self.group(&drawing.label, &drawing.layout, bindings, params, bound)?;
        // A pass ends when it is dropped, and the next cannot begin before.
        self.pass = None;
        let timer = self.context.timer();
        let timestamps = timer.and_then(|timer| timer.begin(self.phase));
        let (color, depth) = attachments;
        let mut pass = self.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(&drawing.label),
            color_attachments: &[Some(color)],
            depth_stencil_attachment: depth,
            timestamp_writes: timestamps.as_ref().map(|t| t.render_writes()),
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(&drawing.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..vertices, 0..1);
        Ok(())
    }

    /// What a shader binds, by the names in it.
    fn group<P: bytemuck::Pod>(
        &self,
        label: &str,
        layout: &wgpu::BindGroupLayout,
        bindings: &[(String, u32)],
        params: &P,
        bound: &[(&str, Binding<'_>)],
    ) -> Result<wgpu::BindGroup> {
        let uniforms = self.context.uniforms();
        let queue = self.context.queue();
        let mut entries = Vec::with_capacity(bindings.len());
        for (name, binding) in bindings {
            let resource = if name == "params" {
                let bytes = bytemuck::bytes_of(params);
                wgpu::BindingResource::Buffer(uniforms.write(queue, bytes))
            } else {
                let found = bound.iter().find(|(n, _)| n == name);
                let Some((_, what)) = found else {
                    let problem = format!("{label}: nothing is bound to `{name}`");
                    return Err(self.context.error(problem, "report it"));
                };
                match what {
                    Binding::Buffer(buffer) => buffer.as_entire_binding(),
                    Binding::Texture(view) => wgpu::BindingResource::TextureView(view),
                }
            };
            entries.push(wgpu::BindGroupEntry {
                binding: *binding,
                resource,
            });
        }
        let descriptor = wgpu::BindGroupDescriptor {
            label: Some(label),
            layout,
            entries: &entries,
        };
        Ok(self.context.device().create_bind_group(&descriptor))
    }
}
