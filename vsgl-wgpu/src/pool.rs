//! Buffers that are used again: a steady frame makes none.

use std::collections::BTreeMap;
use std::ops::Deref;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

/// Sizes are rounded up to this many bytes.
const GRAIN: u64 = 256;
/// Bytes that wait to be used again, at most; beyond, buffers are given back to the device.
const WAITING_MAX: u64 = 1 << 30;

/// Storage buffers by size.
#[derive(Debug, Default)]
pub(crate) struct Pool {
    free: Mutex<Free>,
    made: AtomicU64,
}

#[derive(Debug, Default)]
struct Free {
    by_size: BTreeMap<u64, Vec<wgpu::Buffer>>,
    bytes: u64,
}

/// A buffer that goes back to its pool when it is dropped.
///
/// Commands that were recorded with it stay valid: whoever takes it next is recorded after them.
#[derive(Debug)]
pub(crate) struct Pooled {
    buffer: wgpu::Buffer,
    pool: Arc<Pool>,
}

impl Deref for Pooled {
    type Target = wgpu::Buffer;
    fn deref(&self) -> &wgpu::Buffer {
        &self.buffer
    }
}

impl Drop for Pooled {
    fn drop(&mut self) {
        let Ok(mut free) = self.pool.free.lock() else {
            return;
        };
        let size = self.buffer.size();
        if free.bytes + size <= WAITING_MAX {
            free.bytes += size;
            free.by_size
                .entry(size)
                .or_default()
                .push(self.buffer.clone());
        }
    }
}

impl Pool {
    /// Buffers made since the start.
    pub(crate) fn made(&self) -> u64 {
        self.made.load(Ordering::Relaxed)
    }

    /// A buffer of at least so many bytes; its contents are whatever was there.
    pub(crate) fn take(
        self: &Arc<Self>,
        device: &wgpu::Device,
        bytes: u64,
    ) -> Result<Pooled, String> {
        let size = bytes.max(1).div_ceil(GRAIN) * GRAIN;
        let waiting = self.free.lock().ok().and_then(|mut free| {
            let buffer = free.by_size.get_mut(&size)?.pop()?;
            free.bytes -= size;
            Some(buffer)
        });
        let buffer = match waiting {
            Some(buffer) => buffer,
            None => self.make(device, size)?,
        };
        Ok(Pooled {
            buffer,
            pool: self.clone(),
        })
    }

    fn make(&self, device: &wgpu::Device, size: u64) -> Result<wgpu::Buffer, String> {
        let scope = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("vsgl"),
            size,
            usage: wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::COPY_SRC
                | wgpu::BufferUsages::COPY_DST
                | wgpu::BufferUsages::INDIRECT
                | wgpu::BufferUsages::UNIFORM,
            mapped_at_creation: false,
        });
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(format!("no memory for {size} bytes ({error})"));
        }
        self.made.fetch_add(1, Ordering::Relaxed);
        Ok(buffer)
    }
}
