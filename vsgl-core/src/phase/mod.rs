//! The text of each phase for one element: one texel, one cluster, one pixel against one light.
