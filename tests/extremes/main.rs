//! Scenes and settings at the edge of what can be rendered: whatever comes, no light is infinite, negative or NaN.

mod forms;
mod rooms;
mod scenes;
