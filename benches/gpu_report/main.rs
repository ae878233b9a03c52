//! Times of a GPU phase by phase, at the setting of Tokuyoshi 2016, as a page of Markdown. Run by `scripts/gpu-report`.

mod operations;
mod page;

use page::{Page, Row};
use std::process::ExitCode;
use std::time::Duration;
use vsgl_core::backend::{Backend, PdfInputs, Senders, ShadeInputs};
use vsgl_core::data::SceneData;
use vsgl_core::plan::Plan;
use vsgl_core::render::{Phase, View};
use vsgl_core::scene::{SceneFacts, samples};
use vsgl_core::settings::{Clustering, OcclusionMethod, Settings};
use vsgl_core::{Error, Result};
use vsgl_wgpu::{Timings, WgpuBackend, WgpuOptions, is_software};

const USAGE: &str = "gpu-report [--adapter NAME] [--size WxH]
  NAME is a part of the adapter's name; without, the best one is taken. WxH is 1920x1088 unless given, and 160x90 on a
  software driver.";
/// Runs of a phase whose median is taken, after one that is not counted.
const RUNS: usize = 9;

fn main() -> ExitCode {
    match arguments().and_then(|(adapter, size)| run(adapter, size)) {
        Ok(page) => {
            println!("{page}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("gpu-report: {error}");
            ExitCode::from(match error {
                Error::NoAdapter { .. } => 4,
                Error::Setting { .. } => 2,
                _ => 70,
            })
        }
    }
}

type Size = (u32, u32);

fn arguments() -> Result<(Option<String>, Option<Size>)> {
    let (mut adapter, mut size) = (None, None);
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let value = words.next().unwrap_or_default();
        match &*word {
            "--adapter" => adapter = Some(value),
            "--size" => {
                let parsed = value
                    .split_once('x')
                    .and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
                size =
                    Some(parsed.ok_or_else(|| Error::setting("size", value, "give WIDTHxHEIGHT"))?);
            }
            _ => return Err(Error::setting("arguments", word, USAGE)),
        }
    }
    Ok((adapter, size))
}

fn run(adapter: Option<String>, size: Option<Size>) -> Result<Page> {
    let options = WgpuOptions {
        timing: true,
        adapter,
        ..WgpuOptions::default()
    };
    let gpu = WgpuBackend::headless(&options)?;
    let software = is_software(gpu.context().info());
    let size = size.unwrap_or(if software { (160, 90) } else { (1920, 1088) });
    let mut page = Page::new(gpu.context().info().clone(), size);
    for sample in ["cornell", "columns"] {
        scene(&gpu, sample, size, &mut page)?;
    }
    Ok(page)
}

/// Adds the rows of one scene.
fn scene(gpu: &WgpuBackend, sample: &'static str, size: Size, page: &mut Page) -> Result<()> {
    let scene = samples::by_name(sample)?;
    let data = gpu.upload(SceneData::new(&scene))?;
    let view = View::new(scene.cameras[0].1, size.0, size.1)?;
    let facts = SceneFacts::new(&scene, &scene.lights, &view.camera);
    let plan = |clustering, occlusion| {
        let settings = Settings {
            clustering,
            occlusion,
            ..Settings::default()
        };
        Plan::new(&facts, &settings)
    };
    let partition = plan(Clustering::Partition, OcclusionMethod::None)?;
    let filtered = plan(Clustering::Filtered, OcclusionMethod::None)?;
    let bounces = [&partition, &filtered].map(|plan| plan.bounce.as_ref());
    let [Some(exact), Some(sampled)] = bounces else {
        return Err(Error::setting("scene", sample, "the samples are lit"));
    };
    let mut add =
        |what: &str, phases: &[Phase], work: &mut dyn FnMut() -> Result<()>| -> Result<Duration> {
            let (time, clock) = median(gpu, phases, work)?;
            page.add(Row {
                scene: sample,
                what: what.to_owned(),
                time,
                clock,
                note: String::new(),
            });
            Ok(time)
        };

    add("G-buffer by rays", &[Phase::GBuffer], &mut || {
        gpu.gbuffer(&data, &view, &partition.gbuffer).map(drop)
    })?;
    add("RSM 512² by rays", &[Phase::Rsm], &mut || {
        gpu.rsm(&data, &scene.lights, &exact.rsm).map(drop)
    })?;
    let rsm = gpu.rsm(&data, &scene.lights, &exact.rsm)?;
    let gbuffer = gpu.gbuffer(&data, &view, &partition.gbuffer)?;
    if let Some(cluster) = &exact.cluster {
        add("1024 VSGLs by partition", &[Phase::Cluster], &mut || {
            gpu.cluster(&data, &rsm, None, cluster).map(drop)
        })?;
    }
    if let (Some(pdf), Some(cluster)) = (&sampled.pdf, &sampled.cluster) {
        add(
            "1024 VSGLs by filtered kernels",
            &[Phase::Pdf, Phase::Cluster],
            &mut || {
                let inputs = PdfInputs {
                    scene: &data,
                    rsm: &rsm,
                    gbuffer: &gbuffer,
                    view: &view,
                };
                let pdf = gpu.pdf(&inputs, pdf)?;
                gpu.cluster(&data, &rsm, Some(&pdf), cluster).map(drop)
            },
        )?;
    }
    let Some(cluster) = &exact.cluster else {
        return Ok(());
    };
    let vsgls = gpu.cluster(&data, &rsm, None, cluster)?;
    let pairs = f64::from(size.0) * f64::from(size.1) * 1024.0;
    for occlusion in [OcclusionMethod::None, OcclusionMethod::Rays] {
        let plan = plan(Clustering::Partition, occlusion)?;
        let inputs = ShadeInputs {
            scene: &data,
            gbuffer: &gbuffer,
            view: &view,
            lights: &scene.lights,
            senders: Senders::Vsgls(&vsgls),
        };
        let what = format!("shading, occlusion {occlusion}");
        let (time, clock) = median(gpu, &[Phase::Shade], &mut || {
            gpu.shade(&inputs, &plan.shade, &()).map(drop)
        })?;
        let rate = pairs / time.as_secs_f64();
        let mut note = format!("{:.3} G pairs/s", rate * 1e-9);
        if occlusion == OcclusionMethod::None {
            let each = operations::per_light(&plan)?;
            note += &format!(
                ", {each} float operations a pair: {:.3} TFLOP/s",
                rate * each as f64 * 1e-12
            );
        }
        page.add(Row {
            scene: sample,
            what,
            time,
            clock,
            note,
        });
    }
    Ok(())
}

/// Median time of some phases over several runs, and the clock that it was taken by.
fn median(
    gpu: &WgpuBackend,
    phases: &[Phase],
    work: &mut dyn FnMut() -> Result<()>,
) -> Result<(Duration, vsgl_wgpu::Clock)> {
    work()?;
    gpu.timings()?;
    let mut times = Vec::new();
    let mut clock = vsgl_wgpu::Clock::Wall;
    for _ in 0..RUNS {
        work()?;
        let Some(Timings {
            clock: by,
            phases: all,
        }) = gpu.timings()?
        else {
            return Err(Error::setting(
                "timing",
                "none",
                "ask for it when the device is opened",
            ));
        };
        clock = by;
        let wanted = all.into_iter().filter(|(phase, _)| phases.contains(phase));
        times.push(wanted.map(|(_, time)| time).sum());
    }
    times.sort_unstable();
    Ok((times[RUNS / 2], clock))
}
