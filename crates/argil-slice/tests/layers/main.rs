//! What must be true of the layers of any mesh.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

mod body;
mod defects;
mod properties;
mod soundness;
mod stack;
