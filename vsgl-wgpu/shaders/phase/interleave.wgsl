// Which samples take which share of the virtual lights. Twin of `vsgl-core/src/phase/interleave.rs`.

struct Shares {
    side: u32,
    width: u32,
    height: u32,
}

fn shares_count(own: Shares) -> u32 {
    return own.side * own.side;
}

fn shares_share(own: Shares, place: vec2<u32>) -> u32 {
    return place.x % own.side + own.side * (place.y % own.side);
}

fn shares_sample(own: Shares, index: u32) -> vec2<u32> {
    if own.side == 1u {
        return vec2(index % own.width, index / own.width);
    }
    let side = own.side * TILE;
    let columns = (own.width + side - 1u) / side;
    let rows = (own.height + side - 1u) / side;
    let each = columns * rows * (TILE * TILE);
    let share = index / each;
    let within = index % each;
    let tile = within / (TILE * TILE);
    let place = within % (TILE * TILE);
    let x = tile % columns * TILE + place % TILE;
    let y = tile / columns * TILE + place / TILE;
    return vec2(x * own.side + share % own.side, y * own.side + share / own.side);
}

// The first light of a share that is not before a place in the list.
fn shares_first(from_light: u32, share: u32, stride: u32) -> u32 {
    return from_light + (share + stride - from_light % stride) % stride;
}
