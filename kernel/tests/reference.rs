//! `Φ` and `Φ − 1` against data of 20 digits (`tests/data/*.txt`; each file says what computed it).

use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

struct Case {
    foundation: Foundation,
    wavenumber: f64,
    response: f64,
    minus_one: f64,
}

fn cases(text: &str) -> Vec<Case> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines.map(case).collect()
}

fn case(line: &str) -> Case {
    let [layers, base, k, response, minus_one] = fields(line, ' ');
    let layers = layers.split(';').map(layer).collect();
    Case {
        foundation: Foundation::new(layers, self::base(base)).unwrap(),
        wavenumber: number(k),
        response: number(response),
        minus_one: number(minus_one),
    }
}

fn layer(text: &str) -> Layer {
    let [thickness, young, poisson, interface] = fields(text, ',');
    let interface = match interface {
        "b" => Interface::Bonded,
        "s" => Interface::Frictionless,
        other => panic!("unknown interface {other}"),
    };
    let material = Material::new(number(young), number(poisson)).unwrap();
    Layer::new(number(thickness), material, interface).unwrap()
}

fn base(text: &str) -> Base {
    if text == "rigid" {
        return Base::Rigid;
    }
    let [young, poisson] = fields(text, ',');
    Base::HalfSpace(Material::new(number(young), number(poisson)).unwrap())
}

fn fields<const N: usize>(text: &str, separator: char) -> [&str; N] {
    let fields: Vec<_> = text.split(separator).collect();
    fields.try_into().unwrap()
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

#[test]
fn explore() {
    for text in [include_str!("data/one_layer.txt"), include_str!("data/stacks.txt")] {
        let mut r: Vec<(f64, usize)> = vec![];
        let mut m: Vec<(f64, usize)> = vec![];
        for (i, c) in cases(text).iter().enumerate() {
            let phi = c.foundation.response(c.wavenumber);
            let s = c.wavenumber * c.foundation.thickness();
            r.push((((phi - c.response) / c.response).abs(), i));
            let d = c.foundation.response_minus_one(c.wavenumber);
            let e = (d - c.minus_one).abs() / (c.minus_one.abs() * (1.0 + 2.0 * s));
            m.push((if c.minus_one.abs() < 1e-290 { 0.0 } else { e }, i));
        }
        r.sort_by(|a, b| b.0.total_cmp(&a.0));
        m.sort_by(|a, b| b.0.total_cmp(&a.0));
        let lines: Vec<_> = text.lines().filter(|l| !l.starts_with('#')).collect();
        println!("Φ {:?}", &r[..8]);
        println!("{}\n{}\n{}", lines[r[0].1], lines[r[1].1], lines[r[2].1]);
        println!("Φ−1 {:?}", &m[..8]);
        println!("{}\n{}\n{}", lines[m[0].1], lines[m[1].1], lines[m[2].1]);
    }
}
