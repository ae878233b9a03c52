//! Elementary functions and vectors, from operations that every backend rounds alike.

pub mod elementary;
pub mod moments;
pub mod vec;
