//! `[surface]`: what lies on the foundation, or its own roughness.

use super::draw::Draw;
use super::{Scales, map};

pub fn draw(draw: &mut Draw, scales: Scales) {
    let kind = draw.pick(&[
        "",
        "",
        "bare",
        "film",
        "film",
        "cylinders",
        "cylinders",
        "map",
        "rough",
        "rough",
    ]);
    if kind.is_empty() {
        return;
    }
    draw.line(format!("[surface]\nkind = \"{kind}\""));
    match kind {
        "film" => film(draw, scales),
        "cylinders" => cylinders(draw, scales),
        "map" => {
            springs_of_map(draw, scales);
            let amplitude = scales.depth() * draw.decades([0.05, 0.5]);
            map::draw(draw, "surface", scales, |[x, y]| amplitude * rough(x, y));
        }
        "rough" => {
            let amplitude = scales.depth() * draw.decades([0.01, 0.5]);
            map::draw(draw, "surface", scales, |[x, y]| amplitude * rough(x, y));
        }
        _ => {}
    }
}

fn film(draw: &mut Draw, scales: Scales) {
    let thickness = scales.depth() * draw.decades([0.1, 10.0]);
    let thickness = draw.length(thickness);
    draw.line(format!("thickness = {thickness}"));
    modulus(draw, scales);
    law(draw);
}

fn cylinders(draw: &mut Draw, scales: Scales) {
    let period = match scales.side {
        Some(side) if scales.periodic => side / (2 + draw.below(5)) as f64,
        _ => scales.contact * draw.decades([0.3, 2.0]),
    };
    let radius = period * (0.2 + 0.29 * draw.part());
    let height = scales.depth() * draw.decades([0.1, 10.0]);
    for (key, value) in [("radius", radius), ("height", height), ("period", period)] {
        let value = draw.length(value);
        draw.line(format!("{key} = {value}"));
    }
    let lattice = draw.pick(&["", "square", "square", "hexagonal"]);
    if !lattice.is_empty() {
        draw.line(format!("lattice = \"{lattice}\""));
    }
    if draw.one_in(4) {
        let [x, y] = [0, 1].map(|_| period * draw.part());
        let [x, y] = [x, y].map(|length| draw.length(length));
        draw.line(format!("offset = [{x}, {y}]"));
    }
    if draw.one_in(2) {
        modulus(draw, scales);
    }
    law(draw);
}

/// Springs of one compliance, or of one modulus and the heights of the map.
fn springs_of_map(draw: &mut Draw, scales: Scales) {
    if draw.one_in(2) {
        let compliance = scales.depth() / scales.modulus * draw.decades([0.1, 10.0]);
        let compliance = draw.compliance(compliance);
        draw.line(format!("compliance = {compliance}"));
        draw.sometimes(12, "law = \"logarithmic\"");
    } else {
        modulus(draw, scales);
        law(draw);
    }
}

fn modulus(draw: &mut Draw, scales: Scales) {
    let modulus = scales.modulus * draw.decades([0.01, 10.0]);
    let modulus = draw.pressure(modulus);
    draw.line(format!("young_modulus = {modulus}"));
}

fn law(draw: &mut Draw) {
    let law = draw.pick(&["", "", "linear", "logarithmic"]);
    if !law.is_empty() {
        draw.line(format!("law = \"{law}\""));
    }
}

/// Three waves that fit into the map, of amplitudes that sum to 1; x and y from 0 to 1.
fn rough(x: f64, y: f64) -> f64 {
    let wave = |m: f64, n: f64, phase: f64| (std::f64::consts::TAU * (m * x + n * y) + phase).cos();
    0.5 * wave(1.0, 2.0, 0.3) + 0.3 * wave(3.0, -1.0, 1.1) + 0.2 * wave(-2.0, 4.0, 2.5)
}
