//! needs: phase/unit
// The density on the texels, and drawing from it. Twin of `vsgl-core/src/phase/pdf.rs`.
//
// Reads the density's pyramid from `weight`, which the entry binds.

fn pdf_level_count(size: u32, maps: u32, level: u32) -> u32 {
    let side = size >> level;
    return maps * side * side;
}

fn pdf_level_start(size: u32, maps: u32, level: u32) -> u32 {
    var start = 0u;
    for (var l = 0u; l < level; l += 1u) {
        start += pdf_level_count(size, maps, l);
    }
    return start;
}

// Sizes of a pyramid.
struct Pdf {
    size: u32,
    maps: u32,
}

fn pdf_at(own: Pdf, map_number: u32, level: u32, x: u32, y: u32) -> f32 {
    let side = own.size >> level;
    return weight[pdf_level_start(own.size, own.maps, level) + (map_number * side + y) * side + x];
}

fn pdf_total(own: Pdf, map_number: u32) -> f32 {
    return pdf_at(own, map_number, pdf_top_level(own.size), 0u, 0u);
}

fn pdf_fibonacci(index: u32, count: u32) -> vec2<f32> {
    return vec2((f32(index) + 0.5) / f32(count), pdf_unit(index * GOLDEN_TURN + GOLDEN_TURN / 2u));
}

fn pdf_warp(own: Pdf, map_number: u32, u: f32, v: f32) -> vec2<f32> {
    var rest = vec2(u, v);
    var x = 0u;
    var y = 0u;
    for (var level = pdf_top_level(own.size); level > 0u; level -= 1u) {
        x *= 2u;
        y *= 2u;
        let a = pdf_at(own, map_number, level - 1u, x, y);
        let b = pdf_at(own, map_number, level - 1u, x + 1u, y);
        let c = pdf_at(own, map_number, level - 1u, x, y + 1u);
        let d = pdf_at(own, map_number, level - 1u, x + 1u, y + 1u);
        let row = pdf_choose(a + b, c + d, rest.y);
        let column = pdf_choose(select(a, c, row.second), select(b, d, row.second), rest.x);
        rest = vec2(column.rest, row.rest);
        x += select(0u, 1u, column.second);
        y += select(0u, 1u, row.second);
    }
    return vec2(f32(x) + rest.x, f32(y) + rest.y);
}

struct Choice {
    second: bool,
    rest: f32,
}

fn pdf_choose(first: f32, second: f32, u: f32) -> Choice {
    let total = first + second;
    var part = 0.5;
    if total > 0.0 {
        part = first / total;
    }
    let beyond = second > 0.0 && (u >= part || first <= 0.0) || (total <= 0.0 && u >= part);
    let start = select(u, u - part, beyond);
    let width = select(part, 1.0 - part, beyond);
    var rest = 0.0;
    if width > 0.0 {
        rest = start / width;
    }
    return Choice(beyond, clamp(rest, 0.0, BELOW_ONE));
}
