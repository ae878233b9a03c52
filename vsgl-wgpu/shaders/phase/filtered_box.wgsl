//! needs: math/elementary, phase/unit
// Clusters by filtered importance sampling with square kernels. Twin of `vsgl-core/src/phase/filtered_box.rs`; the folds over
// cells are those of the workgroups in `entry/filtered.wgsl`.

struct Square {
    map: u32,
    x: f32,
    y: f32,
    side: f32,
    scale: f32,
}

struct Cells {
    level: u32,
    column: u32,
    row: u32,
    columns: u32,
    count: u32,
    left: f32,
    right: f32,
    top: f32,
    bottom: f32,
}

fn cells_new(size: u32, x: f32, y: f32, side: f32) -> Cells {
    var level = 0u;
    for (var l = 0u; l < pdf_top_level(size); l += 1u) {
        level = select(level, l + 1u, side > BOX_CELLS * f32(1u << l));
    }
    let scale = 1.0 / f32(1u << level);
    let end = f32(size >> level);
    let half = 0.5 * side;
    let left = max((x - half) * scale, 0.0);
    let right = min((x + half) * scale, end);
    let top = max((y - half) * scale, 0.0);
    let bottom = min((y + half) * scale, end);
    let columns = filtered_box_touched(left, right, end);
    let rows = filtered_box_touched(top, bottom, end);
    return Cells(level, columns.x, rows.x, columns.y, columns.y * rows.y, left, right, top, bottom);
}

struct Cell {
    column: u32,
    row: u32,
    share: f32,
}

fn cells_at(own: Cells, index: u32) -> Cell {
    let column = own.column + index % own.columns;
    let row = own.row + index / own.columns;
    let along = filtered_box_covered(own.left, own.right, f32(column));
    let down = filtered_box_covered(own.top, own.bottom, f32(row));
    return Cell(column, row, along * down);
}

fn filtered_box_touched(low: f32, high: f32, end: f32) -> vec2<u32> {
    let first = min(floor(low), end - 1.0);
    let past = min(ceil(high), end);
    return vec2(u32(first), u32(max(past - first, 1.0)));
}

fn filtered_box_covered(low: f32, high: f32, cell: f32) -> f32 {
    return max(min(high, cell + 1.0) - max(low, cell), 0.0);
}

fn filtered_box_side_of(x: f32) -> f32 {
    let whole = floor(x);
    let power = f32(1u << u32(whole - BOX_LEAST)) * 0.0625;
    return power * elementary_exp((x - whole) * LN_2);
}

fn square_record(own: Square) -> vec4<f32> {
    return vec4(f32(own.map), own.x, own.y, own.side);
}
