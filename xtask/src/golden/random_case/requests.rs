//! `[load]`, `[grid]`, `[solver]` and `[stress]`: what is asked of the case.

use super::Scales;
use super::draw::Draw;
use super::foundation::hardness;

/// Elements per side: few, so that a case takes milliseconds; with and without coarser grids.
const ELEMENTS: [usize; 9] = [16, 24, 31, 32, 32, 36, 40, 48, 64];

pub fn draw(draw: &mut Draw, scales: Scales) {
    load(draw, scales);
    grid(draw, scales);
    solver(draw, scales);
    // A stress in a periodic cell is refused.
    if draw.one_in(if scales.periodic { 20 } else { 4 }) {
        stress(draw, scales);
    }
}

fn load(draw: &mut Draw, scales: Scales) {
    let by_force = draw.one_in(if scales.periodic { 1 } else { 2 });
    let (key, size) = if by_force {
        ("force", scales.force())
    } else {
        ("penetration", scales.depth())
    };
    let value = |draw: &mut Draw, part: f64| {
        if by_force {
            draw.force(part * size)
        } else {
            draw.length(part * size)
        }
    };
    draw.line("[load]");
    match draw.below(6) {
        0 => {
            let [from, to] = [0.2, 1.0].map(|part| value(draw, part));
            let spacing = draw.pick(&["", ", spacing = \"log\"", ", spacing = \"linear\""]);
            draw.line(format!(
                "{key}s = {{ from = {from}, to = {to}, count = 3{spacing} }}"
            ));
        }
        1 => {
            let [a, b, c] = [0.5, 1.0, 0.7].map(|part| value(draw, part));
            draw.line(format!("{key}s = [{a}, {b}, {c}]"));
        }
        _ => {
            let value = value(draw, 1.0);
            draw.line(format!("{key} = {value}"));
        }
    }
    draw.sometimes(8, "sensitivities = true");
}

fn grid(draw: &mut Draw, scales: Scales) {
    let elements = draw.pick(&ELEMENTS);
    draw.line(format!("[grid]\nelements = {elements}"));
    if let Some(side) = scales.side {
        let side = draw.length(side);
        draw.line(format!("side = {side}"));
    }
    if scales.periodic {
        draw.line("boundary = \"periodic\"");
    }
}

fn solver(draw: &mut Draw, scales: Scales) {
    let mut keys = Vec::new();
    if draw.one_in(10) {
        keys.push(hardness(draw, scales));
    }
    if draw.one_in(10) {
        keys.push(format!("tolerance = 1e-{}", 4 + draw.below(8)));
    }
    if draw.one_in(14) {
        keys.push("method = \"active-set\"".into());
    }
    if !keys.is_empty() {
        draw.line("[solver]");
        draw.line(keys.join("\n"));
    }
}

fn stress(draw: &mut Draw, scales: Scales) {
    draw.line("[stress]");
    if draw.one_in(2) {
        let friction = draw.part();
        draw.line(format!("friction = {friction:.2}"));
        let direction = draw.part() * std::f64::consts::TAU;
        let direction = draw.angle(direction);
        draw.sometimes(2, format!("direction = {direction}"));
    }
    if draw.one_in(3) {
        let depths = [0.0, 0.3, 1.0].map(|part| draw.length(part * scales.contact));
        draw.line(format!("depths = [{}]", depths.join(", ")));
    }
    if draw.one_in(4) {
        let extent = draw.length(0.7 * scales.contact);
        draw.line(format!("extent = {extent}"));
    }
}
