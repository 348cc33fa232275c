//! Short closed tours over any symmetric metric: Or-opt, 2-opt, Or-3opt, exact when small.
