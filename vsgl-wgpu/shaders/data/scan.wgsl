// Running sums over a workgroup of 256. Every invocation calls them.

const SCAN: u32 = 256u;
var<workgroup> scan_values: array<u32, SCAN>;

struct Scanned {
    // Sum of the values before this invocation's, and of all.
    before: u32,
    total: u32,
}

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

var<workgroup> scan_bits: array<atomic<u32>, 8>;

// As `scan_group` of ones and zeros, with fewer barriers.
fn scan_flags(local: u32, flag: bool) -> Scanned {
    workgroupBarrier();
    if local < 8u {
        atomicStore(&scan_bits[local], 0u);
    }
    workgroupBarrier();
    let word = local / 32u;
    if flag {
        atomicOr(&scan_bits[word], 1u << (local % 32u));
    }
    workgroupBarrier();
    var scanned = Scanned(0u, 0u);
    for (var w = 0u; w < 8u; w += 1u) {
        let bits = atomicLoad(&scan_bits[w]);
        scanned.total += countOneBits(bits);
        if w < word {
            scanned.before += countOneBits(bits);
        } else if w == word {
            scanned.before += countOneBits(bits & ((1u << (local % 32u)) - 1u));
        }
    }
    return scanned;
}

var<workgroup> scan_sums: array<atomic<u32>, 2>;

// Two sums over all invocations.
fn scan_totals(local: u32, values: vec2<u32>) -> vec2<u32> {
    workgroupBarrier();
    if local < 2u {
        atomicStore(&scan_sums[local], 0u);
    }
    workgroupBarrier();
    if any(values > vec2(0u)) {
        atomicAdd(&scan_sums[0], values.x);
        atomicAdd(&scan_sums[1], values.y);
    }
    workgroupBarrier();
    return vec2(atomicLoad(&scan_sums[0]), atomicLoad(&scan_sums[1]));
}
