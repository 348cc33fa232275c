//! The elastic curve: shortens and smooths a path inside its support envelope.
