//! Every resource through bytes and back: the phases after it must not notice.

use std::sync::Arc;
use vsgl_core::backend::{Backend, PdfInputs, Senders, ShadeInputs};
use vsgl_core::data::{Columns, SceneData};
use vsgl_cpu::CpuBackend;
use vsgl_tests::render::Shot;

/// Down to bytes, and up again.
fn copied<T: Columns>(backend: &CpuBackend, resource: &Arc<T>) -> Arc<T> {
    let here = backend.download(resource).expect("a copy");
    let columns = here.columns();
    // At odd addresses: bytes from a file or a device need not be aligned.
    let shifted: Vec<Vec<u8>> = columns.iter().map(|c| [&[0], c.bytes].concat()).collect();
    let bytes: Vec<&[u8]> = shifted.iter().map(|c| &c[1..]).collect();
    let again = T::from_columns(&here.head(), &bytes).expect("the same columns");
    for (a, b) in again.columns().iter().zip(&columns) {
        assert!(a.bytes == b.bytes, "{} {}", T::NAME, a.name);
        assert_eq!((a.name, a.lanes, a.scalar), (b.name, b.lanes, b.scalar));
    }
    backend.upload(again).expect("room")
}

#[test]
fn phases_by_hand_with_copies_between_make_the_same_picture() {
    for settings in [
        "clustering=partition",
        "clustering=filtered",
        "occlusion=ism map_points=500 map_size=9",
        "clustering=filtered pdf=brsm camera_lights=64",
        "clustering=whole",
        "clustering=nearest-world",
    ] {
        let mut shot = Shot::sample("cornell").with(settings);
        shot.view.aa = 2;
        let plan = shot.plan();
        let bounce = plan.bounce.as_ref().expect("a bounce");
        let cluster = bounce.cluster.as_ref().expect("clusters");
        let b = CpuBackend::new(2).expect("threads");
        let scene = copied(&b, &b.upload(SceneData::new(&shot.scene)).expect("room"));
        let rsm = copied(&b, &b.rsm(&scene, &shot.lights, &bounce.rsm).expect("maps"));
        let gbuffer = copied(
            &b,
            &b.gbuffer(&scene, &shot.view, &plan.gbuffer)
                .expect("receivers"),
        );
        let inputs = PdfInputs {
            scene: &scene,
            rsm: &rsm,
            gbuffer: &gbuffer,
            view: &shot.view,
        };
        let pdf = bounce
            .pdf
            .as_ref()
            .map(|p| copied(&b, &b.pdf(&inputs, p).expect("a density")));
        let vsgls = copied(
            &b,
            &b.cluster(&scene, &rsm, pdf.as_ref(), cluster)
                .expect("clusters"),
        );
        let maps = bounce
            .occlusion
            .as_ref()
            .map(|p| copied(&b, &b.occlusion(&scene, &vsgls, p).expect("shadow maps")));
        let inputs = ShadeInputs {
            scene: &scene,
            gbuffer: &gbuffer,
            view: &shot.view,
            lights: &shot.lights,
            senders: Senders::Vsgls(&vsgls),
            occlusion: maps.as_ref(),
        };
        let radiance = copied(&b, &b.shade(&inputs, &plan.shade, &()).expect("light"));
        let image = copied(
            &b,
            &b.resolve(&gbuffer, &radiance, &shot.view)
                .expect("a picture"),
        );
        assert!(*image == shot.image(), "{settings}");
    }
}
