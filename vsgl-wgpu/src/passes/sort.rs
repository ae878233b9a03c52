//! Stable sort of numbers by what a table says of each.

use crate::context::Context;
use crate::kernel::KernelId;
use crate::pool::Pooled;
use crate::recorder::{Binding, Groups, Recorder};
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;

/// Numbers that a workgroup brings to their places.
pub(crate) const SORT_BLOCK: u32 = 2048;
/// Values of a digit.
const DIGITS: u64 = 256;

/// Twin of `Params` in `entry/sort.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Params {
    shift: u32,
    blocks: u32,
}

const ENTRIES: [&str; 3] = ["digits", "starts", "move_values"];

/// The pipelines that it needs.
pub(super) fn kernels() -> impl Iterator<Item = KernelId> {
    ENTRIES
        .into_iter()
        .map(|entry| KernelId::new("entry/sort", entry, &[]))
}

fn blocks(most: u64) -> u64 {
    most.div_ceil(u64::from(SORT_BLOCK)).max(1)
}

/// Bytes of the counts that sorting `most` numbers takes.
pub(super) fn count_bytes(most: u64) -> u64 {
    4 * DIGITS * blocks(most)
}

/// Records the sort of as many numbers as `length` says, `most` at most, by entries of `table` below `limit`. The numbers are
/// in the first of `values`; the result is in the one that is returned.
pub(super) fn record<'a>(
    recorder: &mut Recorder<'_>,
    [length, table]: [Binding<'_>; 2],
    values: [&'a Pooled; 2],
    count: &Pooled,
    most: u64,
    limit: u64,
) -> Result<[&'a Pooled; 2]> {
    let context: &Context = recorder.context();
    let [mut from, mut to] = values;
    let blocks = blocks(most);
    let bits = limit.next_power_of_two().ilog2();
    for shift in (0..bits).step_by(8) {
        let params = Params {
            shift,
            blocks: blocks as u32,
        };
        let bound = [
            ("length", length.clone()),
            ("table", table.clone()),
            ("value", Binding::Buffer(from)),
            ("count", Binding::Buffer(count)),
            ("value_out", Binding::Buffer(to)),
        ];
        let groups = [blocks, 1, blocks].map(Groups::Count);
        for (entry, groups) in ENTRIES.into_iter().zip(groups) {
            let kernel = context.kernel("entry/sort", entry, &[])?;
            recorder.dispatch(&kernel, &params, &bound, groups)?;
        }
        (from, to) = (to, from);
    }
    Ok([from, to])
}

#[cfg(test)]
mod tests {
    use super::Params;
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!("entry/sort", "Params", Params { shift, blocks });
    }
}
