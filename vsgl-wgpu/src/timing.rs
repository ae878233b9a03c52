//! How long the device takes for each phase.

use std::collections::HashMap;
use std::sync::Mutex;
use std::time::Duration;
use vsgl_core::render::Phase;

/// Passes that can wait for their times to be read. Of a host's frame with more, the later ones are not timed.
const PASSES_MAX: u32 = 512;
/// A phase of ours never has so many passes in one submission.
const PASSES_SPARE: u32 = 8;

/// Where times come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// Timestamps that the device wrote itself.
    Device,
    /// The host's clock around each phase, submitted and waited for alone.
    Wall,
}

/// Time of each phase since the last question, summed over its passes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Timings {
    /// Where the times come from.
    pub clock: Clock,
    /// Phases in the order in which they first ran.
    pub phases: Vec<(Phase, Duration)>,
}

/// Collects times, by timestamp queries where the device has them.
#[derive(Debug)]
pub(crate) struct Timer {
    queries: Option<Queries>,
    /// Passes whose times wait on the device.
    passes: Mutex<Vec<Phase>>,
    /// Times that are known.
    known: Mutex<Vec<(Phase, Duration)>>,
}

#[derive(Debug)]
struct Queries {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    read: wgpu::Buffer,
    nanoseconds: f64,
}

/// The two queries of a pass.
pub(crate) struct Timestamps<'a> {
    set: &'a wgpu::QuerySet,
    first: u32,
}

impl Timestamps<'_> {
    pub(crate) fn writes(&self) -> wgpu::ComputePassTimestampWrites<'_> {
        wgpu::ComputePassTimestampWrites {
            query_set: self.set,
            beginning_of_pass_write_index: Some(self.first),
            end_of_pass_write_index: Some(self.first + 1),
        }
    }

    pub(crate) fn render_writes(&self) -> wgpu::RenderPassTimestampWrites<'_> {
        wgpu::RenderPassTimestampWrites {
            query_set: self.set,
            beginning_of_pass_write_index: Some(self.first),
            end_of_pass_write_index: Some(self.first + 1),
        }
    }
}

impl Timer {
    pub(crate) fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let has = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        Self {
            queries: has.then(|| Queries::new(device, queue)),
            passes: Mutex::default(),
            known: Mutex::default(),
        }
    }

    pub(crate) fn clock(&self) -> Clock {
        if self.queries.is_some() {
            Clock::Device
        } else {
            Clock::Wall
        }
    }

    /// The queries of one more pass; none without device clock, or if too many passes wait already.
    pub(crate) fn begin(&self, phase: Phase) -> Option<Timestamps<'_>> {
        let queries = self.queries.as_ref()?;
        let mut passes = self.passes.lock().ok()?;
        let index = passes.len() as u32;
        if index >= PASSES_MAX {
            return None;
        }
        passes.push(phase);
        Some(Timestamps {
            set: &queries.set,
            first: 2 * index,
        })
    }

    /// Adds time by the host's clock.
    pub(crate) fn add_wall(&self, phase: Phase, time: Duration) {
        if let Ok(mut known) = self.known.lock() {
            known.push((phase, time));
        }
    }

    /// Brings times to the host if hardly more passes can wait. Waits for the device then.
    pub(crate) fn make_room(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
    ) -> Result<(), String> {
        let waiting = self.passes.lock().map_err(|e| e.to_string())?.len() as u32;
        if waiting + PASSES_SPARE > PASSES_MAX {
            self.collect(device, queue)?;
        }
        Ok(())
    }

    fn collect(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<(), String> {
        if let Some(queries) = &self.queries {
            let passes = std::mem::take(&mut *self.passes.lock().map_err(|e| e.to_string())?);
            let spans = queries.read(device, queue, passes.len() as u32)?;
            let mut known = self.known.lock().map_err(|e| e.to_string())?;
            known.extend(passes.into_iter().zip(spans));
        }
        Ok(())
    }

    /// All times since the last question. What was recorded must have been submitted.
    pub(crate) fn take(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
    ) -> Result<Timings, String> {
        self.collect(device, queue)?;
        let times = std::mem::take(&mut *self.known.lock().map_err(|e| e.to_string())?);
        let mut order: Vec<Phase> = Vec::new();
        let mut sums: HashMap<Phase, Duration> = HashMap::new();
        for (phase, time) in times {
            if !order.contains(&phase) {
                order.push(phase);
            }
            *sums.entry(phase).or_default() += time;
        }
        Ok(Timings {
            clock: self.clock(),
            phases: order
                .into_iter()
                .map(|phase| (phase, sums[&phase]))
                .collect(),
        })
    }
}

impl Queries {
    fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let count = 2 * PASSES_MAX;
        let buffer = |usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("vsgl timestamps"),
                size: 8 * u64::from(count),
                usage,
                mapped_at_creation: false,
            })
        };
        Self {
            set: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("vsgl timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            read: buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST),
            nanoseconds: f64::from(queue.get_timestamp_period()),
        }
    }

    fn read(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        passes: u32,
    ) -> Result<Vec<Duration>, String> {
        if passes == 0 {
            return Ok(Vec::new());
        }
        let bytes = 16 * u64::from(passes);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.resolve_query_set(&self.set, 0..2 * passes, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.read, 0, bytes);
        queue.submit([encoder.finish()]);
        let raw = crate::res::mapped(device, &self.read, bytes)?;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&raw);
        let span = |pair: &[u64]| {
            let ticks = pair[1].saturating_sub(pair[0]) as f64;
            Duration::from_nanos((ticks * self.nanoseconds) as u64)
        };
        Ok(ticks.chunks_exact(2).map(span).collect())
    }
}
