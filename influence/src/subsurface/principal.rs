//! Principal values and axes of a symmetric tensor, by Jacobi's rotations.

/// Sweeps over the three pairs of axes; convergence is quadratic, and five reach rounding.
const SWEEPS: usize = 8;

/// The principal values of a symmetric tensor, each with its unit vector, in no particular order.
pub fn axes_of(mut tensor: [[f64; 3]; 3]) -> [(f64, [f64; 3]); 3] {
    // Rows are the current axes.
    let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for _ in 0..SWEEPS {
        if tensor[0][1] == 0.0 && tensor[0][2] == 0.0 && tensor[1][2] == 0.0 {
            break;
        }
        for [p, q, r] in [[0, 1, 2], [0, 2, 1], [1, 2, 0]] {
            rotate(&mut tensor, &mut axes, [p, q, r]);
        }
    }
    std::array::from_fn(|i| (tensor[i][i], axes[i]))
}

/// Rotates the axes p and q so that the tensor's component between them vanishes; r is the third axis.
fn rotate(tensor: &mut [[f64; 3]; 3], axes: &mut [[f64; 3]; 3], [p, q, r]: [usize; 3]) {
    let between = tensor[p][q];
    if between.abs() <= f64::EPSILON * f64::EPSILON * (tensor[p][p].abs() + tensor[q][q].abs()) {
        (tensor[p][q], tensor[q][p]) = (0.0, 0.0);
        return;
    }
    // t = tan φ is the smaller root of t² + 2 θ t = 1 with θ = (a_qq − a_pp)/(2 a_pq)
    let theta = (tensor[q][q] - tensor[p][p]) / (2.0 * between);
    let tan = theta.signum() / (theta.abs() + theta.hypot(1.0));
    let cos = 1.0 / tan.hypot(1.0);
    let sin = tan * cos;
    tensor[p][p] -= tan * between;
    tensor[q][q] += tan * between;
    (tensor[p][q], tensor[q][p]) = (0.0, 0.0);
    let [to_p, to_q] = [tensor[r][p], tensor[r][q]];
    let turned = [cos * to_p - sin * to_q, sin * to_p + cos * to_q];
    for (axis, entry) in [p, q].into_iter().zip(turned) {
        (tensor[r][axis], tensor[axis][r]) = (entry, entry);
    }
    let turned: [[f64; 2]; 3] = std::array::from_fn(|i| {
        let [along_p, along_q] = [axes[p][i], axes[q][i]];
        [cos * along_p - sin * along_q, sin * along_p + cos * along_q]
    });
    axes[p] = turned.map(|[along_p, _]| along_p);
    axes[q] = turned.map(|[_, along_q]| along_q);
}

#[cfg(test)]
mod tests {
    use super::axes_of;

    #[test]
    fn principal_values_and_axes_reproduce_the_tensor() {
        for tensor in [
            [[1.0, 2.0, -3.0], [2.0, 0.5, 4.0], [-3.0, 4.0, -7.0]],
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -2.0]],
            [[1.0, 1e-9, 1e-12], [1e-9, 1.0, 0.0], [1e-12, 0.0, 1.0]],
            [[0.0; 3]; 3],
            [[-1e9, 3.0, 1e-3], [3.0, 1e-6, 7e8], [1e-3, 7e8, 0.0]],
        ] {
            let axes = axes_of(tensor);
            let scale = tensor
                .iter()
                .flatten()
                .fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
            for i in 0..3 {
                for j in 0..3 {
                    let again: f64 = axes
                        .iter()
                        .map(|(value, axis)| value * axis[i] * axis[j])
                        .sum();
                    let dot: f64 = (0..3).map(|k| axes[i].1[k] * axes[j].1[k]).sum();
                    assert!((again - tensor[i][j]).abs() <= 2e-15 * scale, "{tensor:?}");
                    assert!(
                        (dot - f64::from(u8::from(i == j))).abs() < 2e-15,
                        "{tensor:?}"
                    );
                }
            }
        }
    }
}
