//! `write_gcode` of the library, as a libFuzzer program.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| argil_fuzz::write_gcode(bytes));
