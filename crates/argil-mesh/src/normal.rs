/// Normal of a triangle, as long as twice its area.
pub(crate) fn normal(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> [f64; 3] {
    let u: [f64; 3] = [0, 1, 2].map(|axis| b[axis] - a[axis]);
    let v: [f64; 3] = [0, 1, 2].map(|axis| c[axis] - a[axis]);
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// Length of a vector.
pub(crate) fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
}
