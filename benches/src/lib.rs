//! Benchmarks of argil on generated instances.
