// Running sums over a workgroup of 256.

const SCAN: u32 = 256u;
var<workgroup> scan_values: array<u32, SCAN>;

struct Scanned {
    // Sum of the values before this invocation's, and of all.
    before: u32,
    total: u32,
}

// Every invocation calls it.
fn scan_group(local: u32, value: u32) -> Scanned {
    workgroupBarrier();
    scan_values[local] = value;
    workgroupBarrier();
    for (var step = 1u; step < SCAN; step *= 2u) {
        var below = 0u;
        if local >= step {
            below = scan_values[local - step];
        }
        workgroupBarrier();
        scan_values[local] += below;
        workgroupBarrier();
    }
    return Scanned(scan_values[local] - value, scan_values[SCAN - 1u]);
}
