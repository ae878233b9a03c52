//! Threads and runs.

use vsgl_core::data::Columns;
use vsgl_core::render::Frame;
use vsgl_cpu::CpuBackend;
use vsgl_tests::render::Shot;

/// All bytes of all resources of a frame, with their names.
fn bytes(frame: &Frame<CpuBackend>) -> Vec<(String, Vec<u8>)> {
    fn add<T: Columns>(all: &mut Vec<(String, Vec<u8>)>, resource: Option<&T>) {
        let Some(resource) = resource else { return };
        let head = resource
            .head()
            .iter()
            .flat_map(|h| h.to_le_bytes())
            .collect();
        all.push((format!("{} head", T::NAME), head));
        for column in resource.columns() {
            all.push((
                format!("{} {}", T::NAME, column.name),
                column.bytes.to_vec(),
            ));
        }
    }
    let mut all = Vec::new();
    add(&mut all, frame.rsm.as_deref());
    add(&mut all, frame.pdf.as_deref());
    add(&mut all, frame.vsgls.as_deref());
    add(&mut all, frame.occlusion.as_deref());
    add(&mut all, Some(&*frame.gbuffer));
    add(&mut all, Some(&*frame.radiance));
    add(&mut all, Some(&*frame.image));
    all
}

/// Compares without printing what differs: it is long.
fn same(name: &str, first: &[(String, Vec<u8>)], second: &[(String, Vec<u8>)]) {
    assert_eq!(first.len(), second.len(), "{name}");
    for ((what, a), (_, b)) in first.iter().zip(second) {
        assert!(a == b, "{name}: {what} differs");
    }
}

#[test]
fn any_number_of_threads_and_any_run() {
    for settings in [
        "clustering=partition occlusion=rays",
        "clustering=partition occlusion=none",
        "clustering=filtered occlusion=rays",
        "clustering=filtered occlusion=none emission=sg",
        "clustering=whole occlusion=rays",
        "clustering=whole rsm=50 emission=sg",
        "clustering=filtered-box occlusion=none",
        "clustering=nearest-world occlusion=none",
        "clustering=filtered occlusion=none pdf=brsm camera_lights=100",
        "method=vpl rsm=32 occlusion=rays",
        "interleave=4",
        "interleave=2 occlusion=sampled",
        "method=path spp=9",
    ] {
        for (scene, aa) in [("cornell", 1), ("many-lights:3", 2)] {
            let aa = if settings.starts_with("method=path") {
                1
            } else {
                aa
            };
            // Sizes that no piece of work divides.
            let mut shot = Shot::sample(scene).size(37, 19).with(settings);
            shot.view.aa = aa;
            let first = bytes(&shot.frame());
            for threads in [1, 2, 3, 7] {
                shot.threads = threads;
                same(
                    &format!("{scene} {settings}, {threads} threads"),
                    &bytes(&shot.frame()),
                    &first,
                );
            }
        }
    }
}

#[test]
fn a_part_of_the_picture_has_the_bits_of_the_whole() {
    // Every third pixel of the large picture, in blocks of other neighbours.
    let mut shot = Shot::sample("cornell").size(48, 27);
    let whole = shot.image();
    shot.view.stride = 3;
    let part = shot.image();
    for y in 0..part.height {
        for x in 0..part.width {
            let (i, j) = (
                (y * part.width + x) as usize,
                (3 * y * whole.width + 3 * x) as usize,
            );
            assert_eq!(part.indirect()[i], whole.indirect()[j], "{x} {y}");
            assert_eq!(part.direct[i], whole.direct[j], "{x} {y}");
        }
    }
}
