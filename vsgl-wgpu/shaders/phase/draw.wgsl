//! needs: data/emitters, data/lights
// Which light a path asks. Twin of `vsgl-core/src/phase/draw.rs`, with the two lists in place of a function.
//
// Reads `params`, `direct_light` and `lamp` of the entry, and its constant BY_POWER.

fn draw_light_passed(index: u32) -> u32 {
    return direct_light[index].passed;
}

fn draw_lamp_passed(index: u32) -> u32 {
    return select(lamp[index].evenly, lamp[index].by_power, BY_POWER);
}

// What was drawn; `params.lights` or `params.lamps` for nothing.
struct DrawnLight {
    index: u32,
    chance: f32,
}

fn draw_chance(passed: u32, before: u32) -> f32 {
    return f32(passed - before) * (1.0 / DRAW_PARTS);
}

fn draw_light_chance(index: u32) -> f32 {
    var before = 0u;
    if index > 0u {
        before = draw_light_passed(index - 1u);
    }
    return draw_chance(draw_light_passed(index), before);
}

fn draw_lamp_chance(index: u32) -> f32 {
    var before = 0u;
    if index > 0u {
        before = draw_lamp_passed(index - 1u);
    }
    return draw_chance(draw_lamp_passed(index), before);
}

fn draw_light(number: f32) -> DrawnLight {
    let wanted = u32(number * DRAW_PARTS);
    var low = 0u;
    var high = params.lights;
    while low < high {
        let middle = low + (high - low) / 2u;
        if draw_light_passed(middle) > wanted {
            high = middle;
        } else {
            low = middle + 1u;
        }
    }
    if low == params.lights {
        return DrawnLight(low, 0.0);
    }
    return DrawnLight(low, draw_light_chance(low));
}

fn draw_lamp(number: f32) -> DrawnLight {
    let wanted = u32(number * DRAW_PARTS);
    var low = 0u;
    var high = params.lamps;
    while low < high {
        let middle = low + (high - low) / 2u;
        if draw_lamp_passed(middle) > wanted {
            high = middle;
        } else {
            low = middle + 1u;
        }
    }
    if low == params.lamps {
        return DrawnLight(low, 0.0);
    }
    return DrawnLight(low, draw_lamp_chance(low));
}
