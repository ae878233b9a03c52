//! needs: data/partition, data/scan
// Running sums over counts of blocks, however many, by one workgroup.
//
// Reads and writes `count`, which the entry binds.

// Puts the sum of the counts before each block in its place, and returns the sum of all.
fn scan_counts(local: u32, blocks: u32) -> u32 {
    let chunk = blocks_of(blocks, SCAN);
    let first = min(local * chunk, blocks);
    let end = min(first + chunk, blocks);
    var own = 0u;
    for (var b = first; b < end; b += 1u) {
        own += count[b];
    }
    let scanned = scan_group(local, own);
    var passed = scanned.before;
    for (var b = first; b < end; b += 1u) {
        let here = count[b];
        count[b] = passed;
        passed += here;
    }
    return scanned.total;
}
