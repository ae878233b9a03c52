//! The page.

use std::fmt;
use std::time::Duration;
use vsgl_wgpu::wgpu::AdapterInfo;
use vsgl_wgpu::{Clock, is_software};

/// One measurement.
pub(crate) struct Row {
    pub(crate) scene: &'static str,
    pub(crate) what: String,
    pub(crate) time: Duration,
    pub(crate) clock: Clock,
    pub(crate) note: String,
}

/// Everything that was measured on one adapter.
pub(crate) struct Page {
    info: AdapterInfo,
    size: (u32, u32),
    rows: Vec<Row>,
}

impl Page {
    pub(crate) fn new(info: AdapterInfo, size: (u32, u32)) -> Self {
        Self {
            info,
            size,
            rows: Vec::new(),
        }
    }

    pub(crate) fn add(&mut self, row: Row) {
        eprintln!("{} {}: {:?} {}", row.scene, row.what, row.time, row.note);
        self.rows.push(row);
    }
}

impl fmt::Display for Page {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let AdapterInfo {
            name,
            driver,
            driver_info,
            backend,
            ..
        } = &self.info;
        writeln!(f, "# {name}\n")?;
        writeln!(
            f,
            "{backend}, {driver} {driver_info}; vsgl {}.",
            env!("CARGO_PKG_VERSION")
        )?;
        writeln!(
            f,
            "{}x{} pixels, RSM 512², 1024 VSGLs. Made by `scripts/gpu-report`: median of nine runs after one.",
            self.size.0, self.size.1
        )?;
        if is_software(&self.info) {
            writeln!(
                f,
                "\n**A software driver on the processor, not a GPU.** These are times of the processor."
            )?;
        }
        writeln!(
            f,
            "\n| scene | phase | time | clock | |\n| --- | --- | --- | --- | --- |"
        )?;
        for row in &self.rows {
            let clock = match row.clock {
                Clock::Device => "device",
                Clock::Wall => "wall",
            };
            let time = row.time.as_secs_f64() * 1e3;
            writeln!(
                f,
                "| {} | {} | {time:.3} ms | {clock} | {} |",
                row.scene, row.what, row.note
            )?;
        }
        Ok(())
    }
}
