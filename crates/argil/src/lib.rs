//! Turns a mesh into one continuous deposition path: no transfer move from the first gram of clay to the last.
