//! Spherical Gaussians.
