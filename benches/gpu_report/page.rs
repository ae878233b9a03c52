//! The page.

use crate::Scale;
use std::fmt;
use std::time::Duration;
use vsgl_core::render::Phase;
use vsgl_wgpu::wgpu::AdapterInfo;
use vsgl_wgpu::{Clock, is_software};

/// One measurement.
pub(crate) struct Row {
    pub(crate) scene: &'static str,
    pub(crate) what: String,
    /// Times of the phases that ran; none if the settings do not go together.
    pub(crate) phases: Vec<(Phase, Duration)>,
    pub(crate) clock: Clock,
    pub(crate) note: String,
}

/// Everything that was measured on one adapter.
pub(crate) struct Page {
    info: AdapterInfo,
    scale: Scale,
    rows: Vec<Row>,
}

impl Page {
    pub(crate) fn new(info: AdapterInfo, scale: Scale) -> Self {
        Self {
            info,
            scale,
            rows: Vec::new(),
        }
    }

    pub(crate) fn add(&mut self, row: Row) {
        let all: Duration = row.phases.iter().map(|p| p.1).sum();
        eprintln!("{} {}: {all:?} {}", row.scene, row.what, row.note);
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
        let Scale { size, quick, runs } = self.scale;
        let (texels, lights, camera) = if quick {
            (64, 64, 128)
        } else {
            (512, 1024, 2048)
        };
        writeln!(
            f,
            "{}x{} pixels, RSM {texels}², {lights} VSGLs, density from {camera} lights of the camera, unless a row says \
             otherwise. Made by `scripts/gpu-report`: median of {runs} runs after one, of frames as a whole.",
            size.0, size.1
        )?;
        if is_software(&self.info) {
            writeln!(
                f,
                "\n**A software driver on the processor, not a GPU.** These are times of the processor."
            )?;
        }
        writeln!(
            f,
            "\nThe paper's 19.3 ms are of a rasterised picture; ours are by rays, and the second column of times leaves the \
             camera's out. Milliseconds.\n\n| scene | what | frame | without G-buffer | phases | clock | |\n\
             | --- | --- | --- | --- | --- | --- | --- |"
        )?;
        for row in &self.rows {
            let clock = match row.clock {
                Clock::Device => "device",
                Clock::Wall => "wall",
            };
            let sum = |camera: bool| {
                let times = row.phases.iter();
                let times = times.filter(|(phase, _)| camera || *phase != Phase::GBuffer);
                times.map(|(_, time)| time.as_secs_f64() * 1e3).sum::<f64>()
            };
            let phases: Vec<String> = row
                .phases
                .iter()
                .map(|(phase, time)| format!("{phase} {:.3}", time.as_secs_f64() * 1e3))
                .collect();
            writeln!(
                f,
                "| {} | {} | {:.3} | {:.3} | {} | {clock} | {} |",
                row.scene,
                row.what,
                sum(true),
                sum(false),
                phases.join(", "),
                row.note
            )?;
        }
        Ok(())
    }
}
