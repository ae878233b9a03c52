//! Dispatches, recorded one after the other into one compute pass.

use crate::context::Context;
use crate::kernel::{INVOCATIONS, Kernel};
use std::sync::atomic::{AtomicU64, Ordering};
use vsgl_core::Result;

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
    /// So many bytes of a buffer from an offset on, a multiple of 256.
    Range(&'a wgpu::Buffer, u64, u64),
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

/// Records dispatches.
pub(crate) struct Recorder<'a> {
    context: &'a Context,
    pass: wgpu::ComputePass<'a>,
}

impl<'a> Recorder<'a> {
    /// Records into a host's encoder, under a phase's name.
    pub(crate) fn new(
        context: &'a Context,
        encoder: &'a mut wgpu::CommandEncoder,
        phase: vsgl_core::render::Phase,
    ) -> Self {
        let timestamps = context.timer().and_then(|timer| timer.begin(phase));
        let pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(&format!("vsgl {phase}")),
            timestamp_writes: timestamps.as_ref().map(|t| t.writes()),
        });
        Self { context, pass }
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
        let uniforms = self.context.uniforms();
        let queue = self.context.queue();
        let mut entries = Vec::with_capacity(kernel.bindings.len());
        for (name, binding) in &kernel.bindings {
            let resource = if name == "params" {
                let bytes = bytemuck::bytes_of(params);
                wgpu::BindingResource::Buffer(uniforms.write(queue, bytes))
            } else {
                let found = bound.iter().find(|(n, _)| n == name);
                let Some((_, what)) = found else {
                    let problem = format!("{}: nothing is bound to `{name}`", kernel.label);
                    return Err(self.context.error(problem, "report it"));
                };
                match what {
                    Binding::Buffer(buffer) => buffer.as_entire_binding(),
                    Binding::Range(buffer, offset, size) => {
                        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                            buffer,
                            offset: *offset,
                            size: wgpu::BufferSize::new(*size),
                        })
                    }
                    Binding::Texture(view) => wgpu::BindingResource::TextureView(view),
                }
            };
            entries.push(wgpu::BindGroupEntry {
                binding: *binding,
                resource,
            });
        }
        let group = self
            .context
            .device()
            .create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(&kernel.label),
                layout: &kernel.layout,
                entries: &entries,
            });
        self.pass.set_pipeline(&kernel.pipeline);
        self.pass.set_bind_group(0, &group, &[]);
        let [x, y, z] = match groups {
            Groups::Items(items) => grid(items.div_ceil(u64::from(INVOCATIONS))),
            Groups::Count(count) => grid(count),
            Groups::Indirect(buffer, offset) => {
                self.pass.dispatch_workgroups_indirect(buffer, offset);
                return Ok(());
            }
        };
        self.pass.dispatch_workgroups(x, y, z);
        Ok(())
    }
}
