//! Indices packed by `EXT_meshopt_compression`: neighbouring triangles share edges and vertices.

/// Unpacks `count` indices of a triangle list, a multiple of 3; none if the data are not sound.
///
/// Source: Khronos Group, `EXT_meshopt_compression`, appendix A, "Mode 1: triangles", version 1.
pub(super) fn triangles(data: &[u8], count: usize) -> Option<Vec<u32>> {
    /// A table of the sixteen usual pairs of codes stands at the end.
    const TAIL: usize = 16;
    let (&0xe1, data) = data.split_first()? else {
        return None;
    };
    let (data, table) = data.split_at(data.len().checked_sub(TAIL)?);
    let (codes, mut data) = data.split_at_checked(count / 3)?;
    let mut state = State::default();
    let mut indices = Vec::with_capacity(count);
    for &code in codes {
        let triangle = match code {
            0..0xf0 => state.beside(code, &mut data)?,
            0xf0..0xfe => state.apart(0, table[usize::from(code & 15)], &mut data)?,
            0xfe.. => {
                let pair = take(&mut data)?;
                if pair == 0 {
                    state.next = 0;
                }
                let first = if code == 0xfe { 0 } else { 15 };
                state.apart(first, pair, &mut data)?
            }
        };
        indices.extend(triangle);
    }
    data.is_empty().then_some(indices)
}

/// Unpacks `count` indices in no particular order; none if the data are not sound.
///
/// Source: the same, "Mode 2: indices", version 1.
pub(super) fn sequence(data: &[u8], count: usize) -> Option<Vec<u32>> {
    const TAIL: usize = 4;
    let (&0xd1, data) = data.split_first()? else {
        return None;
    };
    let mut data = data.split_at(data.len().checked_sub(TAIL)?).0;
    // One byte at least for each.
    if count > data.len() {
        return None;
    }
    let mut last = [0u32; 2];
    let mut indices = Vec::with_capacity(count);
    for _ in 0..count {
        let code = varint(&mut data)?;
        let last = &mut last[code as usize & 1];
        *last = last.wrapping_add(zigzag(code >> 1));
        indices.push(*last);
    }
    data.is_empty().then_some(indices)
}

/// What was seen lately.
struct State {
    edges: [[u32; 2]; 16],
    edge: usize,
    vertices: [u32; 16],
    vertex: usize,
    /// The lowest index that was not yet seen.
    next: u32,
    /// The last index that was written out.
    last: u32,
}

impl Default for State {
    fn default() -> Self {
        Self {
            edges: [[u32::MAX; 2]; 16],
            edge: 0,
            vertices: [u32::MAX; 16],
            vertex: 0,
            next: 0,
            last: 0,
        }
    }
}

impl State {
    /// A triangle on an edge that was seen.
    fn beside(&mut self, code: u8, data: &mut &[u8]) -> Option<[u32; 3]> {
        let [a, b] = self.edges[self.edge.wrapping_sub(1 + usize::from(code >> 4)) & 15];
        let third = usize::from(code & 15);
        let (c, new) = match third {
            0 => (self.unseen(), true),
            1..13 => (
                self.vertices[self.vertex.wrapping_sub(1 + third) & 15],
                false,
            ),
            13 => (self.near(u32::MAX), true),
            14 => (self.near(1), true),
            _ => (self.written(data)?, true),
        };
        self.see_vertex(c, new);
        self.see_edge(c, b);
        self.see_edge(a, c);
        Some([a, b, c])
    }

    /// A triangle without such an edge; `pair` says what its second and third corners are.
    fn apart(&mut self, first: u8, pair: u8, data: &mut &[u8]) -> Option<[u32; 3]> {
        let (second, third) = (pair >> 4, pair & 15);
        let a = if first == 0 { self.unseen() } else { 0 };
        let b = self.unseen_or_seen(second);
        let c = self.unseen_or_seen(third);
        let a = if first == 15 { self.written(data)? } else { a };
        let b = if second == 15 { self.written(data)? } else { b };
        let c = if third == 15 { self.written(data)? } else { c };
        self.see_vertex(a, true);
        self.see_vertex(b, second == 0 || second == 15);
        self.see_vertex(c, third == 0 || third == 15);
        self.see_edge(b, a);
        self.see_edge(c, b);
        self.see_edge(a, c);
        Some([a, b, c])
    }

    fn unseen(&mut self) -> u32 {
        let index = self.next;
        self.next = index.wrapping_add(1);
        index
    }

    fn unseen_or_seen(&mut self, code: u8) -> u32 {
        match code {
            0 => self.unseen(),
            back => self.vertices[self.vertex.wrapping_sub(usize::from(back)) & 15],
        }
    }

    fn near(&mut self, step: u32) -> u32 {
        self.last = self.last.wrapping_add(step);
        self.last
    }

    fn written(&mut self, data: &mut &[u8]) -> Option<u32> {
        let step = zigzag(varint(data)?);
        Some(self.near(step))
    }

    /// Notes a vertex; one that is known already will be overwritten by the next.
    fn see_vertex(&mut self, vertex: u32, new: bool) {
        self.vertices[self.vertex] = vertex;
        self.vertex = (self.vertex + usize::from(new)) & 15;
    }

    fn see_edge(&mut self, a: u32, b: u32) {
        self.edges[self.edge] = [a, b];
        self.edge = (self.edge + 1) & 15;
    }
}

fn take(data: &mut &[u8]) -> Option<u8> {
    let (&byte, rest) = data.split_first()?;
    *data = rest;
    Some(byte)
}

/// Seven bits a byte, the lowest first.
fn varint(data: &mut &[u8]) -> Option<u32> {
    let mut value = 0u32;
    for shift in [0, 7, 14, 21, 28] {
        let byte = take(data)?;
        value |= u32::from(byte & 127) << shift;
        if byte < 128 {
            break;
        }
    }
    Some(value)
}

/// Even numbers up, odd ones down.
fn zigzag(code: u32) -> u32 {
    (code >> 1) ^ (code & 1).wrapping_neg()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: [u8; 16] = [
        0, 0x76, 0x87, 0x56, 0x67, 0x78, 0xa9, 0x86, 0x65, 0x89, 0x68, 0x98, 0x01, 0x69, 0, 0,
    ];

    fn packed(codes: &[u8], data: &[u8]) -> Vec<u8> {
        [&[0xe1], codes, data, &TABLE].concat()
    }

    #[test]
    fn a_strip_of_new_vertices() {
        // Three new ones; then on the edge seen last but one, and on the last one, a new vertex each.
        let data = packed(&[0xf0, 0x10, 0x00], &[]);
        assert_eq!(triangles(&data, 9), Some(vec![0, 1, 2, 2, 1, 3, 2, 3, 4]));
    }

    #[test]
    fn indices_far_away_are_written_out() {
        // All three written: +10, +1, -3; then one step down and one up from the last.
        let data = packed(&[0xff, 0x0d, 0x0e], &[0xff, 20, 2, 5]);
        assert_eq!(
            triangles(&data, 9),
            Some(vec![10, 11, 8, 10, 8, 7, 10, 7, 8])
        );
        for length in 0..data.len() {
            assert_eq!(triangles(&data[..length], 9), None);
        }
        assert_eq!(triangles(&packed(&[0xf0], &[0]), 3), None);
    }

    #[test]
    fn sequences_step_from_either_of_two_places() {
        let data = [0xd1, 8, 0x85, 0x02, 4, 7, 0, 0, 0, 0];
        // +2 from the first place, +65 from the second, +1 from the first, -2 from the second.
        assert_eq!(sequence(&data, 4), Some(vec![2, 65, 3, 63]));
        assert_eq!(sequence(&data, 3), None);
        assert_eq!(sequence(&data, 5), None);
        assert_eq!(sequence(&[0xd0, 8, 0, 0, 0, 0], 1), None);
    }
}
