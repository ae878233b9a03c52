//! needs: math/elementary, phase/pdf
// Clusters by modified filtered importance sampling. Twin of `vsgl-core/src/phase/filtered.rs`.

struct Kernel {
    map: u32,
    x: f32,
    y: f32,
    level: f32,
    scale: f32,
}

struct Footprint {
    level: u32,
    columns: vec2<u32>,
    rows: vec2<u32>,
    weights: vec4<f32>,
}

fn filtered_footprint(size: u32, x: f32, y: f32, level: u32) -> Footprint {
    let side = size >> level;
    let scale = 1.0 / f32(1u << level);
    let along = filtered_split(x * scale - 0.5, side);
    let down = filtered_split(y * scale - 0.5, side);
    let s = along.fraction;
    let t = down.fraction;
    return Footprint(
        level,
        vec2(along.index, min(along.index + 1u, side - 1u)),
        vec2(down.index, min(down.index + 1u, side - 1u)),
        vec4((1.0 - s) * (1.0 - t), s * (1.0 - t), (1.0 - s) * t, s * t),
    );
}

struct Neighbour {
    index: u32,
    fraction: f32,
}

fn filtered_split(x: f32, side: u32) -> Neighbour {
    let low = floor(x);
    let fraction = select(x - low, 0.0, low < 0.0);
    return Neighbour(min(u32(max(low, 0.0)), side - 1u), fraction);
}

// The footprints on the two levels, and the share of the higher.
struct Taps {
    low: Footprint,
    high: Footprint,
    fraction: f32,
}

fn filtered_taps(size: u32, x: f32, y: f32, level: f32) -> Taps {
    let top = pdf_top_level(size);
    let low = min(u32(max(level, 0.0)), top);
    let high = min(low + 1u, top);
    let fraction = clamp(level - f32(low), 0.0, 1.0);
    return Taps(filtered_footprint(size, x, y, low), filtered_footprint(size, x, y, high), fraction);
}

fn filtered_mean_weight(pdf: Pdf, map_number: u32, x: f32, y: f32, level: f32) -> f32 {
    let taps = filtered_taps(pdf.size, x, y, level);
    return filtered_mean_of(pdf, map_number, taps.low, 1.0 - taps.fraction)
        + filtered_mean_of(pdf, map_number, taps.high, taps.fraction);
}

fn filtered_mean_of(pdf: Pdf, map_number: u32, foot: Footprint, part: f32) -> f32 {
    let per_texel = filtered_per_texel(foot.level);
    let w = foot.weights * part;
    let a = w.x * pdf_at(pdf, map_number, foot.level, foot.columns.x, foot.rows.x) / per_texel;
    let b = w.y * pdf_at(pdf, map_number, foot.level, foot.columns.y, foot.rows.x) / per_texel;
    let c = w.z * pdf_at(pdf, map_number, foot.level, foot.columns.x, foot.rows.y) / per_texel;
    let d = w.w * pdf_at(pdf, map_number, foot.level, foot.columns.y, foot.rows.y) / per_texel;
    return (a + b) + (c + d);
}

fn filtered_per_texel(level: u32) -> f32 {
    let side = f32(1u << level);
    return side * side;
}

fn filtered_kernel(
    pdf: Pdf,
    map_number: u32,
    x: f32,
    y: f32,
    count: u32,
    overlap: f32,
    bisections: u32,
) -> Kernel {
    let top = f32(pdf_top_level(pdf.size));
    let total = pdf_total(pdf, map_number);
    let wanted = min(overlap / f32(count), 1.0) * total;
    var low = 0.0;
    var high = top;
    for (var i = 0u; i < bisections; i += 1u) {
        let middle = 0.5 * (low + high);
        let held = filtered_mean_weight(pdf, map_number, x, y, middle) * filtered_area(middle);
        let below = held < wanted;
        low = select(low, middle, below);
        high = select(middle, high, below);
    }
    let level = select(0.5 * (low + high), top, wanted >= total);
    let mean = filtered_mean_weight(pdf, map_number, x, y, level);
    var scale = 0.0;
    if mean > 0.0 {
        scale = total / (f32(count) * mean);
    }
    return Kernel(map_number, x, y, level, scale);
}

fn filtered_original(pdf: Pdf, map_number: u32, x: f32, y: f32, count: u32, overlap: f32) -> Kernel {
    let top = pdf_top_level(pdf.size);
    let texels = filtered_per_texel(top);
    let last = pdf.size - 1u;
    let own = pdf_at(pdf, map_number, 0u, min(u32(x), last), min(u32(y), last));
    var alike = 0.0;
    if own > 0.0 {
        alike = min(pdf_total(pdf, map_number) / (f32(count) * own), texels);
    }
    let covered = clamp(overlap * alike, 1.0, texels);
    let level = select(elementary_log(covered) * LEVELS_PER_NEPER, f32(top), covered >= texels);
    return Kernel(map_number, x, y, max(level, 0.0), alike);
}

const LEVELS_PER_NEPER: f32 = 0.5 / LN_2;

fn filtered_area(level: f32) -> f32 {
    let whole = floor(level);
    return filtered_per_texel(u32(whole)) * filtered_four_to_the(level - whole);
}

fn filtered_four_to_the(x: f32) -> f32 {
    return elementary_exp(x * (2.0 * LN_2));
}

fn kernel_record(own: Kernel) -> vec4<f32> {
    return vec4(f32(own.map), own.x, own.y, sqrt(filtered_area(own.level)));
}
