//! Elements of accessors, read one at a time from ranges that were checked beforehand.

use super::buffers::Buffers;
use super::document::{Document, lookup};
use super::fault::{Fault, Result};
use gltf::json::accessor::{Accessor, ComponentType, Type, sparse};
use gltf::json::validation::Checked;
use gltf::json::{Index, buffer};

/// An accessor of `N` components an element, as floating-point numbers.
pub(super) struct Vectors<'a, const N: usize> {
    source: Source<'a, N>,
    kind: ComponentType,
    normalized: bool,
    /// Elements that a sparse accessor replaces, by rising index.
    replaced: Vec<(u32, [f32; N])>,
}

/// Where the numbers come from.
enum Source<'a, const N: usize> {
    View(Elements<'a>),
    /// Unpacked, before integers become shares of their range.
    Unpacked(Vec<[f32; N]>),
}

impl<'a, const N: usize> Vectors<'a, N> {
    /// Checks accessor `index` and everything that it reaches. `place` is where the index stands.
    pub(super) fn new(
        document: &'a Document,
        buffers: &'a Buffers<'_>,
        index: Index<Accessor>,
        place: impl FnOnce() -> String,
    ) -> Result<Self> {
        let accessors = &document.root.accessors;
        let accessor = lookup(accessors, "accessors", index.value(), place)?;
        let here = format!("accessors[{}]", index.value());
        let kind = component_type(accessor, &here)?;
        check_type::<N>(accessor, &here)?;
        if kind == ComponentType::U32 {
            return Err(Fault::new(
                format!("{here}.componentType"),
                "32-bit integers in a vertex attribute",
                "floats, or integers of 8 or 16 bits, are expected",
            ));
        }
        Ok(Self {
            source: Source::View(Elements::of(buffers, accessor, kind, N, &here)?),
            kind,
            normalized: accessor.normalized,
            replaced: replaced(buffers, accessor, kind, &here)?,
        })
    }

    /// Elements that were packed, in the place of those of accessor `index`.
    pub(super) fn unpacked(
        document: &Document,
        index: Index<Accessor>,
        numbers: Vec<f32>,
        place: impl FnOnce() -> String,
    ) -> Result<Self> {
        let accessors = &document.root.accessors;
        let accessor = lookup(accessors, "accessors", index.value(), place)?;
        let here = format!("accessors[{}]", index.value());
        let kind = component_type(accessor, &here)?;
        check_type::<N>(accessor, &here)?;
        Ok(Self {
            source: Source::Unpacked(numbers.as_chunks().0.to_vec()),
            kind,
            normalized: accessor.normalized,
            replaced: Vec::new(),
        })
    }

    /// The same with integers as shares of their range, as colours and weights are, whatever the accessor says.
    pub(super) fn into_shares(mut self) -> Self {
        self.normalized = true;
        self
    }

    /// Number of elements.
    pub(super) fn len(&self) -> usize {
        match &self.source {
            Source::View(elements) => elements.count,
            Source::Unpacked(elements) => elements.len(),
        }
    }

    /// Element `index`, which must be below [`Vectors::len`].
    pub(super) fn get(&self, index: u32) -> [f32; N] {
        match self.replaced.binary_search_by_key(&index, |&(i, _)| i) {
            Ok(found) => self.replaced[found].1,
            Err(_) => match &self.source {
                Source::View(elements) => vector(elements, index as usize, self.normalized),
                Source::Unpacked(elements) => {
                    elements[index as usize].map(|x| share(x, self.kind, self.normalized))
                }
            },
        }
    }
}

/// How many components an element of accessor `index` has; none for a type that glTF 2.0 does not have.
pub(super) fn component_count(
    document: &Document,
    index: Index<Accessor>,
    place: impl FnOnce() -> String,
) -> Result<Option<usize>> {
    let accessors = &document.root.accessors;
    let accessor = lookup(accessors, "accessors", index.value(), place)?;
    Ok(match accessor.type_ {
        Checked::Valid(kind) => Some(kind.multiplicity()),
        Checked::Invalid => None,
    })
}

/// An accessor of indices.
pub(super) enum Indices<'a> {
    View(ViewIndices<'a>),
    Unpacked(Vec<u32>),
}

/// Indices as they stand in a buffer.
pub(super) struct ViewIndices<'a>(Elements<'a>);

impl<'a> Indices<'a> {
    /// Checks accessor `index` and everything that it reaches. `place` is where the index stands.
    pub(super) fn new(
        document: &'a Document,
        buffers: &'a Buffers<'_>,
        index: Index<Accessor>,
        place: impl FnOnce() -> String,
    ) -> Result<Self> {
        let accessors = &document.root.accessors;
        let accessor = lookup(accessors, "accessors", index.value(), place)?;
        let here = format!("accessors[{}]", index.value());
        check_type::<1>(accessor, &here)?;
        let kind = component_type(accessor, &here)?;
        check_index_type(kind, &here)?;
        if accessor.sparse.is_some() {
            return Err(Fault::new(
                format!("{here}.sparse"),
                "sparse indices are not supported",
                "export the scene without",
            ));
        }
        let elements = Elements::of(buffers, accessor, kind, 1, &here)?;
        Ok(Self::View(ViewIndices(elements)))
    }

    /// Number of indices.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::View(ViewIndices(elements)) => elements.count,
            Self::Unpacked(indices) => indices.len(),
        }
    }

    /// Index `index`, which must be below [`Indices::len`].
    pub(super) fn get(&self, index: usize) -> u32 {
        match self {
            Self::View(ViewIndices(elements)) => integer(elements.element(index), elements.kind),
            Self::Unpacked(indices) => indices[index],
        }
    }
}

/// Elements at equal distances in a range of bytes that is known to hold them all.
struct Elements<'a> {
    bytes: &'a [u8],
    count: usize,
    stride: usize,
    size: usize,
    kind: ComponentType,
}

impl<'a> Elements<'a> {
    fn of(
        buffers: &'a Buffers<'_>,
        accessor: &Accessor,
        kind: ComponentType,
        components: usize,
        here: &str,
    ) -> Result<Self> {
        let offset = accessor.byte_offset.unwrap_or_default().0;
        let count = accessor.count.0;
        Self::new(
            buffers,
            accessor.buffer_view,
            offset,
            count,
            kind,
            components,
            here,
        )
    }

    fn new(
        buffers: &'a Buffers<'_>,
        view: Option<Index<buffer::View>>,
        offset: u64,
        count: u64,
        kind: ComponentType,
        components: usize,
        here: &str,
    ) -> Result<Self> {
        /// Without a buffer view all elements are zero: the same zeros, again and again.
        const ZEROS: &[u8] = &[0; 64];
        let size = components * kind.size();
        let Some(view) = view else {
            return Ok(Self {
                bytes: ZEROS,
                count: usize::try_from(count).unwrap_or(usize::MAX),
                stride: 0,
                size,
                kind,
            });
        };
        let (bytes, stride) = buffers.view(view, || format!("{here}.bufferView"))?;
        let stride = stride.unwrap_or(size);
        if stride < size {
            return Err(Fault::new(
                format!("bufferViews[{}].byteStride", view.value()),
                format!("{stride} bytes are less than the {size} of an element"),
                "the file is broken; export it again",
            ));
        }
        let fits = |count: u64| {
            let last = (stride as u64).checked_mul(count.checked_sub(1)?)?;
            let end = last.checked_add(offset)?.checked_add(size as u64)?;
            (end <= bytes.len() as u64).then_some(count as usize)
        };
        let count = if count == 0 { Some(0) } else { fits(count) }.ok_or_else(|| {
            Fault::new(
                here,
                format!(
                    "{count} elements from byte {offset} reach beyond the {} bytes of bufferViews[{}]",
                    bytes.len(),
                    view.value()
                ),
                "the file is broken; export it again",
            )
        })?;
        let bytes = if count == 0 {
            &[]
        } else {
            &bytes[offset as usize..]
        };
        Ok(Self {
            bytes,
            count,
            stride,
            size,
            kind,
        })
    }

    fn element(&self, index: usize) -> &[u8] {
        let start = index * self.stride;
        &self.bytes[start..start + self.size]
    }
}

/// The elements that a sparse accessor puts in the place of others.
fn replaced<const N: usize>(
    buffers: &Buffers<'_>,
    accessor: &Accessor,
    kind: ComponentType,
    here: &str,
) -> Result<Vec<(u32, [f32; N])>> {
    let Some(sparse::Sparse {
        count,
        indices,
        values,
        ..
    }) = &accessor.sparse
    else {
        return Ok(Vec::new());
    };
    let here = format!("{here}.sparse");
    let Checked::Valid(index_kind) = indices.component_type else {
        return Err(unknown_component_type(&format!("{here}.indices")));
    };
    let (at, view) = (indices.byte_offset.0, Some(indices.buffer_view));
    let indices = Elements::new(buffers, view, at, count.0, index_kind.0, 1, &here)?;
    let (at, view) = (values.byte_offset.0, Some(values.buffer_view));
    let values = Elements::new(buffers, view, at, count.0, kind, N, &here)?;
    let mut replaced = Vec::with_capacity(indices.count);
    for i in 0..indices.count {
        let index = integer(indices.element(i), index_kind.0);
        let rising = replaced.last().is_none_or(|&(last, _)| last < index);
        if !rising || u64::from(index) >= accessor.count.0 {
            return Err(Fault::new(
                format!("{here}.indices"),
                format!("number {i} is {index}: out of order or out of range"),
                "the file is broken; export it again",
            ));
        }
        replaced.push((index, vector(&values, i, accessor.normalized)));
    }
    Ok(replaced)
}

fn vector<const N: usize>(elements: &Elements<'_>, index: usize, normalized: bool) -> [f32; N] {
    let bytes = elements.element(index);
    let size = elements.kind.size();
    std::array::from_fn(|i| number(&bytes[i * size..], elements.kind, normalized))
}

fn number(bytes: &[u8], kind: ComponentType, normalized: bool) -> f32 {
    let value = match kind {
        ComponentType::F32 => f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
        ComponentType::I8 => f32::from(bytes[0] as i8),
        ComponentType::U8 => f32::from(bytes[0]),
        ComponentType::I16 => f32::from(i16::from_le_bytes([bytes[0], bytes[1]])),
        ComponentType::U16 => f32::from(u16::from_le_bytes([bytes[0], bytes[1]])),
        ComponentType::U32 => integer(bytes, kind) as f32,
    };
    share(value, kind, normalized)
}

/// Source: glTF 2.0 specification, 3.6.2.2 (normalised integers; the most negative value counts as -1).
fn share(value: f32, kind: ComponentType, normalized: bool) -> f32 {
    let full = match kind {
        ComponentType::F32 => return value,
        ComponentType::I8 => 127.0,
        ComponentType::U8 => 255.0,
        ComponentType::I16 => 32767.0,
        ComponentType::U16 => 65535.0,
        ComponentType::U32 => u32::MAX as f32,
    };
    if normalized {
        (value / full).max(-1.0)
    } else {
        value
    }
}

fn integer(bytes: &[u8], kind: ComponentType) -> u32 {
    match kind {
        ComponentType::U8 | ComponentType::I8 => u32::from(bytes[0]),
        ComponentType::U16 | ComponentType::I16 => {
            u32::from(u16::from_le_bytes([bytes[0], bytes[1]]))
        }
        ComponentType::U32 | ComponentType::F32 => {
            u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])
        }
    }
}

fn component_type(accessor: &Accessor, here: &str) -> Result<ComponentType> {
    match accessor.component_type {
        Checked::Valid(kind) => Ok(kind.0),
        Checked::Invalid => Err(unknown_component_type(here)),
    }
}

fn unknown_component_type(here: &str) -> Fault {
    Fault::new(
        format!("{here}.componentType"),
        "is not one of glTF 2.0",
        "the file is broken; export it again",
    )
}

fn check_index_type(kind: ComponentType, here: &str) -> Result<()> {
    match kind {
        ComponentType::U8 | ComponentType::U16 | ComponentType::U32 => Ok(()),
        ComponentType::I8 | ComponentType::I16 | ComponentType::F32 => Err(Fault::new(
            format!("{here}.componentType"),
            "not an unsigned integer, but used as indices",
            "the file is broken; export it again",
        )),
    }
}

fn check_type<const N: usize>(accessor: &Accessor, here: &str) -> Result<()> {
    let (expected, name) = match N {
        1 => (Type::Scalar, "SCALAR"),
        2 => (Type::Vec2, "VEC2"),
        3 => (Type::Vec3, "VEC3"),
        4 => (Type::Vec4, "VEC4"),
        _ => (Type::Mat4, "MAT4"),
    };
    if accessor.type_ == Checked::Valid(expected) {
        return Ok(());
    }
    Err(Fault::new(
        format!("{here}.type"),
        format!("is not {name}, as its use asks for"),
        "the file is broken; export it again",
    ))
}
