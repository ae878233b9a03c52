//! Resources of core on the device: columns in buffers, and the way there and back.

use crate::context::Context;
use crate::params::TexelLayout;
use crate::pool::Pooled;
use crate::recorder::Binding;
use crate::texels::Texels;
use std::marker::PhantomData;
use std::sync::mpsc;
use vsgl_core::Result;
use vsgl_core::data::Columns;

/// Columns of one resource that lie one after the other in one buffer, so that a shader binds them together.
///
/// Others have a buffer each.
const GROUPS: &[(&str, &[&str])] = &[
    (
        "gbuffer",
        &["position", "normal", "diffuse", "specular", "tangent"],
    ),
    (
        "rsm",
        &[
            "position", "normal", "diffuse", "specular", "grazing", "tangent",
        ],
    ),
    ("vsgls", &["diffuse", "specular", "target"]),
    (
        "radiance",
        &["direct", "indirect_diffuse", "indirect_glossy"],
    ),
    ("radiance", &["sums", "emitted"]),
    (
        "image",
        &[
            "direct",
            "indirect_diffuse",
            "indirect_glossy",
            "albedo",
            "normal",
            "depth",
        ],
    ),
];
/// Columns that are kept as texels of an integer texture: what is read where a ray has hit, not on its way.
const TEXELS: (&str, &[&str]) = (
    "scene",
    &[
        "corner_texcoord",
        "corner_texcoord_second",
        "corner_tangent",
        "corner_color",
        "triangle_material",
        "material",
        "texture",
        "texel",
        "srgb",
    ],
);

/// The resource whose number of entries shaders read from a buffer.
const COUNTED: &str = "vsgls";

/// A resource on the device. Its buffers go back to the pool when it is dropped.
#[derive(Debug)]
pub struct WgpuRes<T> {
    pub(crate) head: Vec<u32>,
    columns: Vec<Stored>,
    buffers: Vec<Pooled>,
    texels: Option<Texels>,
    /// Where columns begin among the words of the texels, for shaders.
    layout: Option<Pooled>,
    /// Number of entries that count, where only the device knows it: first word of this buffer. The columns named after it
    /// hold room for more.
    count: Option<(Pooled, &'static [&'static str])>,
    resource: PhantomData<fn() -> T>,
}

/// Where a column lies.
#[derive(Clone, Debug)]
struct Stored {
    name: &'static str,
    place: Place,
    bytes: u64,
    /// Bytes of an entry.
    stride: u64,
}

#[derive(Clone, Copy, Debug)]
enum Place {
    Buffer { index: usize, offset: u64 },
    Texels { first: u64 },
}

/// The shape of a column: name, bytes of an entry, entries.
pub(crate) type Shape = (&'static str, u64, u64);

impl<T: Columns> WgpuRes<T> {
    /// Room for columns of given shapes; contents are whatever was there.
    pub(crate) fn new(context: &Context, head: Vec<u32>, shapes: &[Shape]) -> Result<Self> {
        let groups: Vec<&[&str]> = GROUPS
            .iter()
            .filter(|(resource, _)| *resource == T::NAME)
            .map(|(_, columns)| *columns)
            .collect();
        let mut columns = Vec::new();
        let mut buffers: Vec<Pooled> = Vec::new();
        for grouped in &groups {
            let bytes: u64 = shapes
                .iter()
                .filter(|(name, ..)| grouped.contains(name))
                .map(|(_, stride, count)| stride * count)
                .sum();
            buffers.push(context.buffer(&format!("the resource `{}`", T::NAME), bytes)?);
        }
        let mut passed = vec![0; groups.len()];
        for &(name, stride, count) in shapes {
            let bytes = stride * count;
            let group = groups.iter().position(|columns| columns.contains(&name));
            let place = if let Some(index) = group {
                passed[index] += bytes;
                Place::Buffer {
                    index,
                    offset: passed[index] - bytes,
                }
            } else if TEXELS.0 == T::NAME && TEXELS.1.contains(&name) {
                Place::Texels { first: 0 }
            } else {
                let what = format!("column `{name}` of the resource `{}`", T::NAME);
                buffers.push(context.buffer(&what, bytes)?);
                Place::Buffer {
                    index: buffers.len() - 1,
                    offset: 0,
                }
            };
            columns.push(Stored {
                name,
                place,
                bytes,
                stride,
            });
        }
        Ok(Self {
            head,
            columns,
            buffers,
            texels: None,
            layout: None,
            count: None,
            resource: PhantomData,
        })
    }

    /// With the number of entries of some columns in the first word of a buffer.
    pub(crate) fn counted(mut self, count: Pooled, columns: &'static [&'static str]) -> Self {
        self.count = Some((count, columns));
        self
    }

    /// The buffer whose first word is the number of entries.
    pub(crate) fn count_buffer(&self) -> &wgpu::Buffer {
        let count = self.count.as_ref();
        &count
            .expect("clusters have it, and nothing else is asked")
            .0
    }

    /// The buffer of a column, or of the group that it begins.
    pub(crate) fn bind(&self, name: &str) -> Binding<'_> {
        match self.column(name).place {
            Place::Buffer { index, .. } => Binding::Buffer(&self.buffers[index]),
            Place::Texels { .. } => self.texels().bind(),
        }
    }

    /// Entries that a column has room for.
    pub(crate) fn len(&self, name: &str) -> u64 {
        let column = self.column(name);
        column.bytes / column.stride
    }

    /// Where a column begins among the words of [`Self::texels`].
    pub(crate) fn first_word(&self, name: &str) -> u32 {
        match self.column(name).place {
            Place::Texels { first } => first as u32,
            Place::Buffer { .. } => 0,
        }
    }

    /// The uniform buffer that says where columns begin among the texels.
    pub(crate) fn layout(&self) -> Binding<'_> {
        let layout = self.layout.as_ref();
        Binding::Buffer(layout.expect("only scenes have texels, and theirs are made with them"))
    }

    pub(crate) fn texels(&self) -> &Texels {
        self.texels
            .as_ref()
            .expect("only scenes have texels, and theirs are made with them")
    }

    fn column(&self, name: &str) -> &Stored {
        let found = self.columns.iter().find(|c| c.name == name);
        found.unwrap_or_else(|| panic!("no column `{name}` in `{}`", T::NAME))
    }

    /// From the host.
    pub(crate) fn upload(context: &Context, value: &T) -> Result<Self> {
        let columns = value.columns();
        let shapes: Vec<Shape> = columns
            .iter()
            .map(|c| {
                let stride = 4 * c.lanes as u64;
                (c.name, stride, c.bytes.len() as u64 / stride)
            })
            .collect();
        let mut made = Self::new(context, value.head(), &shapes)?;
        let mut words: Vec<u32> = Vec::new();
        for (column, stored) in columns.iter().zip(&mut made.columns) {
            match &mut stored.place {
                Place::Buffer { index, offset } => {
                    if !column.bytes.is_empty() {
                        context
                            .queue()
                            .write_buffer(&made.buffers[*index], *offset, column.bytes);
                    }
                }
                Place::Texels { first } => {
                    *first = words.len() as u64;
                    words.extend(bytemuck::pod_collect_to_vec::<u8, u32>(column.bytes));
                }
            }
        }
        if T::NAME == TEXELS.0 {
            made.texels = Some(Texels::upload(context, &words)?);
            let layout = TexelLayout::of(&made);
            let bytes = bytemuck::bytes_of(&layout);
            let buffer = context.buffer("where columns of the scene lie", bytes.len() as u64)?;
            context.queue().write_buffer(&buffer, 0, bytes);
            made.layout = Some(buffer);
        }
        if T::NAME == COUNTED {
            let count = context.buffer("the number of clusters", 4)?;
            context
                .queue()
                .write_buffer(&count, 0, bytemuck::bytes_of(&made.head[0]));
            made.count = Some((count, &[]));
        }
        context.check()?;
        Ok(made)
    }

    /// To the host. Waits for the device.
    pub(crate) fn download(&self, context: &Context) -> Result<T> {
        let count = match &self.count {
            Some((buffer, _)) => Some(u64::from(self.read_words(context, buffer, 4)?[0])),
            None => None,
        };
        let mut bytes: Vec<Vec<u8>> = Vec::new();
        for column in &self.columns {
            let length = match (&self.count, count) {
                (Some((_, counted)), Some(count)) if counted.contains(&column.name) => {
                    column.bytes.min(count * column.stride)
                }
                _ => column.bytes,
            };
            bytes.push(match column.place {
                Place::Buffer { index, offset } => {
                    read(context, &self.buffers[index], offset, length)?
                }
                Place::Texels { first } => self.texels().read(context, first, length)?,
            });
        }
        let mut head = self.head.clone();
        if let (Some(count), [first, ..]) = (count, &mut head[..]) {
            *first = count as u32;
        }
        let slices: Vec<&[u8]> = bytes.iter().map(Vec::as_slice).collect();
        T::from_columns(&head, &slices)
    }

    fn read_words(&self, context: &Context, buffer: &wgpu::Buffer, bytes: u64) -> Result<Vec<u32>> {
        Ok(bytemuck::pod_collect_to_vec(&read(
            context, buffer, 0, bytes,
        )?))
    }
}

/// Bytes of a buffer, brought to the host.
pub(crate) fn read(
    context: &Context,
    buffer: &wgpu::Buffer,
    offset: u64,
    bytes: u64,
) -> Result<Vec<u8>> {
    if bytes == 0 {
        return Ok(Vec::new());
    }
    let device = context.device();
    let staging = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("vsgl download"),
        size: bytes,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_buffer_to_buffer(buffer, offset, &staging, 0, bytes);
    context.queue().submit([encoder.finish()]);
    let mapped = mapped(device, &staging, bytes);
    context.check()?;
    mapped.map_err(|problem| context.error(problem, "try again, or use `--backend cpu`"))
}

/// Contents of a buffer that can be mapped, once the device is done.
pub(crate) fn mapped(
    device: &wgpu::Device,
    buffer: &wgpu::Buffer,
    bytes: u64,
) -> std::result::Result<Vec<u8>, String> {
    let (sender, receiver) = mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, 0..bytes, move |result| {
        // Nobody waits for it only if the device was lost before.
        let _ = sender.send(result);
    });
    device
        .poll(wgpu::PollType::wait_indefinitely())
        .map_err(|e| e.to_string())?;
    receiver
        .recv()
        .map_err(|e| e.to_string())?
        .map_err(|e| e.to_string())?;
    let view = buffer
        .get_mapped_range(0..bytes)
        .map_err(|e| e.to_string())?;
    let contents = view.to_vec();
    drop(view);
    buffer.unmap();
    Ok(contents)
}
