//! Reflectance.
