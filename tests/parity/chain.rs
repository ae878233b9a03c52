//! The chain of phases on two backends: a fault in one phase shows in that phase and in the whole, and nowhere else.

use std::ops::Range;
use std::sync::Arc;
use vsgl_core::Result;
use vsgl_core::backend::{Backend, PdfInputs, Senders, ShadeInputs};
use vsgl_core::data::{Columns, GBuffer, Image, Occlusion, Pdf, Radiance, Rsm, SceneData, Vsgls};
use vsgl_core::parity::{Origin, Party, Stage, Step, Subject, Tolerance, chain};
use vsgl_core::plan::{
    ClusterPlan, GBufferPlan, OcclusionPlan, PathPlan, PdfPlan, ReconstructPlan, RsmPlan, ShadePlan,
};
use vsgl_core::render::{Observer, Phase, View};
use vsgl_core::scene::Light;
use vsgl_cpu::CpuBackend;
use vsgl_tests::render::Shot;

/// The CPU with a fault in one phase.
struct Faulty {
    cpu: CpuBackend,
    fault: Option<Phase>,
}

impl Faulty {
    fn spoil<T: Columns>(
        &self,
        phase: Phase,
        sound: Result<Arc<T>>,
        spoil: impl FnOnce(&mut T),
    ) -> Result<Arc<T>> {
        let mut value = T::clone(&*sound?);
        if self.fault == Some(phase) {
            spoil(&mut value);
        }
        Ok(Arc::new(value))
    }
}

impl Backend for Faulty {
    type Res<T: Columns> = Arc<T>;

    fn name(&self) -> &'static str {
        "faulty"
    }

    fn upload<T: Columns>(&self, value: T) -> Result<Arc<T>> {
        self.cpu.upload(value)
    }

    fn download<T: Columns>(&self, resource: &Arc<T>) -> Result<T> {
        self.cpu.download(resource)
    }

    fn finish(&self) -> Result<()> {
        self.cpu.finish()
    }

    fn gbuffer(
        &self,
        scene: &Arc<SceneData>,
        view: &View,
        plan: &GBufferPlan,
    ) -> Result<Arc<GBuffer>> {
        let sound = self.cpu.gbuffer(scene, view, plan);
        let spoil = |g: &mut GBuffer| g.diffuse.iter_mut().flatten().for_each(|c| *c *= 1.01);
        self.spoil(Phase::GBuffer, sound, spoil)
    }

    fn rsm(&self, scene: &Arc<SceneData>, lights: &[Light], plan: &RsmPlan) -> Result<Arc<Rsm>> {
        let sound = self.cpu.rsm(scene, lights, plan);
        let spoil = |r: &mut Rsm| r.diffuse.iter_mut().flatten().for_each(|c| *c *= 1.01);
        self.spoil(Phase::Rsm, sound, spoil)
    }

    fn pdf(&self, inputs: &PdfInputs<'_, Self>, plan: &PdfPlan) -> Result<Arc<Pdf>> {
        let inputs = PdfInputs::<CpuBackend> {
            scene: inputs.scene,
            rsm: inputs.rsm,
            gbuffer: inputs.gbuffer,
            view: inputs.view,
        };
        let sound = self.cpu.pdf(&inputs, plan);
        // Another scale alone would draw the same lights.
        self.spoil(Phase::Pdf, sound, |p| {
            p.weight.iter_mut().step_by(2).for_each(|w| *w *= 1.5)
        })
    }

    fn cluster(
        &self,
        scene: &Arc<SceneData>,
        rsm: &Arc<Rsm>,
        pdf: Option<&Arc<Pdf>>,
        plan: &ClusterPlan,
    ) -> Result<Arc<Vsgls>> {
        let sound = self.cpu.cluster(scene, rsm, pdf, plan);
        let spoil = |v: &mut Vsgls| v.diffuse.iter_mut().for_each(|d| d.intensity[0] *= 1.01);
        self.spoil(Phase::Cluster, sound, spoil)
    }

    fn occlusion(
        &self,
        scene: &Arc<SceneData>,
        vsgls: &Arc<Vsgls>,
        plan: &OcclusionPlan,
    ) -> Result<Arc<Occlusion>> {
        let sound = self.cpu.occlusion(scene, vsgls, plan);
        // A little nearer is open all the same.
        let spoil = |o: &mut Occlusion| o.depth.iter_mut().for_each(|d| *d *= 0.5);
        self.spoil(Phase::Occlusion, sound, spoil)
    }

    fn shade(
        &self,
        inputs: &ShadeInputs<'_, Self>,
        plan: &ShadePlan,
        observer: &dyn Observer,
    ) -> Result<Arc<Radiance>> {
        let inputs = ShadeInputs::<CpuBackend> {
            scene: inputs.scene,
            gbuffer: inputs.gbuffer,
            view: inputs.view,
            lights: inputs.lights,
            senders: match inputs.senders {
                Senders::None => Senders::None,
                Senders::Vsgls(vsgls) => Senders::Vsgls(vsgls),
                Senders::Vpls(rsm) => Senders::Vpls(rsm),
            },
            occlusion: inputs.occlusion,
        };
        let sound = self.cpu.shade(&inputs, plan, observer);
        let spoil = |r: &mut Radiance| r.direct.iter_mut().flatten().for_each(|c| *c *= 1.01);
        self.spoil(Phase::Shade, sound, spoil)
    }

    fn reconstruct(
        &self,
        gbuffer: &Arc<GBuffer>,
        radiance: &Arc<Radiance>,
        plan: &ReconstructPlan,
    ) -> Result<Arc<Radiance>> {
        let sound = self.cpu.reconstruct(gbuffer, radiance, plan);
        let dim = |r: &mut Radiance| {
            r.indirect_diffuse
                .iter_mut()
                .flatten()
                .for_each(|c| *c *= 1.01);
        };
        self.spoil(Phase::Reconstruct, sound, dim)
    }

    fn trace(
        &self,
        scene: &Arc<SceneData>,
        lights: &[Light],
        view: &View,
        plan: &PathPlan,
        samples: Range<u32>,
        observer: &dyn Observer,
    ) -> Result<Arc<Radiance>> {
        let sound = self.cpu.trace(scene, lights, view, plan, samples, observer);
        let spoil = |r: &mut Radiance| r.direct.iter_mut().flatten().for_each(|c| *c *= 1.01);
        self.spoil(Phase::Trace, sound, spoil)
    }

    fn resolve(
        &self,
        gbuffer: &Arc<GBuffer>,
        radiance: &Arc<Radiance>,
        view: &View,
    ) -> Result<Arc<Image>> {
        let sound = self.cpu.resolve(gbuffer, radiance, view);
        let spoil = |i: &mut Image| i.depth.iter_mut().for_each(|d| *d *= 1.01);
        self.spoil(Phase::Resolve, sound, spoil)
    }
}

fn run(shot: &Shot, fault: Option<Phase>) -> Vec<Step> {
    let cpu = || CpuBackend::new(1).expect("threads");
    let (reference, tested) = (cpu(), Faulty { cpu: cpu(), fault });
    let subject = Subject {
        scene: &SceneData::new(&shot.scene),
        lights: &shot.lights,
        view: &shot.view,
        plan: &shot.plan(),
    };
    let reference = Party {
        backend: &reference,
        origin: Origin::new("cpu", "1 thread"),
    };
    let tested = Party {
        backend: &tested,
        origin: Origin::new("faulty", "1 thread"),
    };
    chain(&reference, &tested, &subject, &Tolerance::STRICT, &()).expect("it runs")
}

fn stages(steps: &[Step]) -> Vec<String> {
    steps.iter().map(|s| s.stage.to_string()).collect()
}

#[test]
fn equal_backends_agree_in_every_phase_of_every_plan() {
    let shot = || Shot::sample("cornell").size(16, 9);
    let mut supersampled = shot();
    supersampled.view.aa = 2;
    let mut dark = shot();
    dark.lights.clear();
    for (shot, phases) in [
        (shot(), "gbuffer rsm cluster shade resolve frame"),
        (supersampled, "gbuffer rsm cluster shade resolve frame"),
        (
            shot().with("clustering=filtered"),
            "gbuffer rsm pdf cluster shade resolve frame",
        ),
        (
            shot().with("clustering=filtered pdf=brsm camera_lights=40"),
            "gbuffer rsm pdf cluster shade resolve frame",
        ),
        (
            shot().with("method=vpl rsm=8"),
            "gbuffer rsm shade resolve frame",
        ),
        (
            shot().with("interleave=2 occlusion=sampled"),
            "gbuffer rsm cluster shade reconstruct resolve frame",
        ),
        (shot().with("method=path spp=3"), "gbuffer trace frame"),
        (dark, "gbuffer shade resolve frame"),
    ] {
        let steps = run(&shot, None);
        assert_eq!(stages(&steps).join(" "), phases);
        for step in &steps {
            let failures = step.comparison.failures();
            assert!(failures.is_empty(), "{}: {failures:?}", step.stage);
        }
    }
}

#[test]
fn a_fault_shows_in_its_phase_and_in_the_frame_alone() {
    let shot = Shot::sample("cornell")
        .size(16, 9)
        .with("clustering=filtered interleave=2 occlusion=ism lights=32");
    for fault in [
        Phase::GBuffer,
        Phase::Rsm,
        Phase::Pdf,
        Phase::Cluster,
        Phase::Occlusion,
        Phase::Shade,
        Phase::Reconstruct,
        Phase::Resolve,
    ] {
        let steps = run(&shot, Some(fault));
        let failed: Vec<Stage> = steps
            .iter()
            .filter(|s| !s.comparison.passed())
            .map(|s| s.stage)
            .collect();
        assert_eq!(failed, [Stage::Phase(fault), Stage::Frame], "{fault}");
    }
    let shot = Shot::sample("cornell")
        .size(16, 9)
        .with("method=path spp=3");
    let steps = run(&shot, Some(Phase::Trace));
    let failed = steps.iter().filter(|s| !s.comparison.passed());
    let failed: Vec<Stage> = failed.map(|s| s.stage).collect();
    assert_eq!(failed, [Stage::Phase(Phase::Trace), Stage::Frame]);
}
