//! needs: phase/shade
// Virtual point lights as shading reads them: seven times four numbers each, from `sender`, which the entry binds.

const SENDER_STRIDE: u32 = 7u;

struct Sender {
    point: PointSender,
    // Unit geometric normal on the lit side.
    facing: vec3<f32>,
    lit: bool,
}

fn sender_at(j: u32) -> Sender {
    let at = SENDER_STRIDE * j;
    let a = sender[at];
    let b = sender[at + 1u];
    let c = sender[at + 2u];
    let d = sender[at + 3u];
    let e = sender[at + 4u];
    let f = sender[at + 5u];
    let g = sender[at + 6u];
    let point = PointSender(a.xyz, a.w, b.xyz, c.xyz, d.xyz, c.w, d.w, e.xyz, f.xyz, b.w, e.w, f.w);
    return Sender(point, g.xyz, g.w > 0.0);
}
