//! scratch
use pellicle_influence::*;
use pellicle_kernel::*;
use std::collections::BTreeMap;
use std::time::Instant;
fn main() {
    let file = std::env::args().nth(1).unwrap();
    let txt = std::fs::read_to_string(file).unwrap();
    let mut worst: BTreeMap<String, (f64, String)> = BTreeMap::new();
    let mut cache: BTreeMap<String, RadialTables> = BTreeMap::new();
    for l in txt.lines() {
        let f: Vec<&str> = l.split_whitespace().collect();
        let g = |i: usize| f[i].parse::<f64>().unwrap();
        let lam = g(3);
        let u = g(6);
        let uh = g(7);
        let key = format!("{} {} {}", f[0], f[1], f[2]);
        let t = cache.entry(key.clone()).or_insert_with(|| {
            let fo = Foundation::coated(
                1.0,
                Material::new(1.0, g(1)).unwrap(),
                Material::new(1.0 / g(0), g(2)).unwrap(),
            )
            .unwrap();
            let t0 = Instant::now();
            let t = RadialTables::build(&fo).unwrap();
            println!(
                "{key}: build {:?} est {:e}",
                t0.elapsed(),
                t.error_estimate()
            );
            t
        });
        let a = 1.0 / lam;
        let k = t.coefficient(2.0 * a, [f[4].parse().unwrap(), f[5].parse().unwrap()]) / a; // U = k E1/(a)
        let phi0 = t.foundation().response_at_zero().min(1.0);
        let e = (k - u).abs() / u.abs().max(phi0 * uh);
        let w = worst
            .entry(format!("{key} {}", f[3]))
            .or_insert((0.0, String::new()));
        if e >= w.0 {
            *w = (e, format!("{} {} {k:e} {u:e}", f[4], f[5]));
        }
    }
    for (k, v) in worst {
        println!("{k}: {:e} at {}", v.0, v.1);
    }
}
