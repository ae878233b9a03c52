//! The shape that all resources share, and the macro that gives it to them.

use crate::error::{Error, Result};

/// Type of the numbers of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// 32-bit IEEE float.
    F32,
    /// 32-bit unsigned integer.
    U32,
}

/// One entry of a column: a number, a small vector or a record of `LANES` numbers of one type.
pub trait Element: bytemuck::Pod {
    /// Type of the numbers.
    const SCALAR: Scalar;
    /// How many numbers an entry holds.
    const LANES: usize = size_of::<Self>() / 4;
}

impl Element for u32 {
    const SCALAR: Scalar = Scalar::U32;
}
impl Element for f32 {
    const SCALAR: Scalar = Scalar::F32;
}
impl<const N: usize> Element for [f32; N]
where
    [f32; N]: bytemuck::Pod,
{
    const SCALAR: Scalar = Scalar::F32;
}

/// One named array of a resource.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a> {
    /// Name of the field.
    pub name: &'static str,
    /// Type of its numbers.
    pub scalar: Scalar,
    /// Numbers an entry.
    pub lanes: usize,
    /// The numbers, in the machine's byte order.
    pub bytes: &'a [u8],
}

/// Plain data between phases: a head of a few integers, and named arrays.
pub trait Columns: Clone + Send + Sync + std::fmt::Debug + 'static {
    /// Name of the resource, as in messages and dumps.
    const NAME: &'static str;

    /// What is not per entry: sizes and counts.
    fn head(&self) -> Vec<u32>;
    /// All arrays, in a fixed order.
    fn columns(&self) -> Vec<Column<'_>>;
    /// The resource that has this head and these arrays; the inverse of the two above.
    ///
    /// # Errors
    /// [`Error::Columns`] if the number of columns or of bytes does not fit the type.
    fn from_columns(head: &[u32], columns: &[&[u8]]) -> Result<Self>;
}

/// Copies bytes into entries; the bytes need not be aligned.
pub(crate) fn entries<T: Element>(
    resource: &'static str,
    name: &'static str,
    bytes: &[u8],
) -> Result<Vec<T>> {
    if !bytes.len().is_multiple_of(size_of::<T>()) {
        let problem = format!(
            "column `{name}` has {} bytes, not a multiple of {}",
            bytes.len(),
            size_of::<T>()
        );
        return Err(Error::Columns { resource, problem });
    }
    Ok(bytemuck::pod_collect_to_vec(bytes))
}

/// Declares a resource: a struct of `u32` head fields and vectors, and its [`Columns`].
macro_rules! columns {
    (
        $(#[$meta:meta])*
        pub struct $type:ident = $name:literal {
            head { $( $(#[$hmeta:meta])* $head:ident ),* $(,)? }
            $( $(#[$cmeta:meta])* $column:ident : $element:ty ),* $(,)?
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $type {
            $( $(#[$hmeta])* pub $head: u32, )*
            $( $(#[$cmeta])* pub $column: Vec<$element>, )*
        }

        impl $type {
            /// Adds the entries of a part after those that are there. Room for `count` entries in all is made with the
            /// first part, so that nothing is held twice while a column grows.
            pub fn append(&mut self, part: &Self, count: usize) {
                $(
                    if self.$column.is_empty() && !part.$column.is_empty() {
                        self.$column.reserve_exact(count);
                    }
                    self.$column.extend_from_slice(&part.$column);
                )*
            }
        }

        impl $crate::data::Columns for $type {
            const NAME: &'static str = $name;

            fn head(&self) -> Vec<u32> {
                vec![$( self.$head ),*]
            }

            fn columns(&self) -> Vec<$crate::data::Column<'_>> {
                vec![$( $crate::data::Column {
                    name: stringify!($column),
                    scalar: <$element as $crate::data::Element>::SCALAR,
                    lanes: <$element as $crate::data::Element>::LANES,
                    bytes: bytemuck::cast_slice(&self.$column),
                } ),*]
            }

            fn from_columns(head: &[u32], columns: &[&[u8]]) -> $crate::error::Result<Self> {
                let [$( $head ),*] = *head else {
                    let problem = format!("{} head numbers", head.len());
                    return Err($crate::error::Error::Columns { resource: $name, problem });
                };
                let [$( $column ),*] = *columns else {
                    let problem = format!("{} columns", columns.len());
                    return Err($crate::error::Error::Columns { resource: $name, problem });
                };
                Ok(Self {
                    $( $head, )*
                    $( $column: $crate::data::columns::entries($name, stringify!($column), $column)?, )*
                })
            }
        }
    };
}
pub(crate) use columns;
