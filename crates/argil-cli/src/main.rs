//! The program `argil`.
fn main() {}
