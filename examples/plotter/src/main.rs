//! Reads a drawing, writes HPGL.
#![forbid(unsafe_code)]

use std::error::Error;
use std::io::{Read, Write, stdin, stdout};

use argil_plotter::{one_line, read_drawing, write_hpgl};

/// Width of the pen, mm.
const PEN: f64 = 0.5;

fn main() -> Result<(), Box<dyn Error>> {
    let mut text = String::new();
    stdin().read_to_string(&mut text)?;
    let line = one_line(&read_drawing(&text)?, PEN)?;
    stdout().write_all(write_hpgl(&line).as_bytes())?;
    Ok(())
}
