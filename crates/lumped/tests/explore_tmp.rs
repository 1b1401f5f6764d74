#![allow(clippy::print_stdout)]
use std::f64::consts::TAU;
use dynamics::motion::{Scheme, State, StepControl};
use lumped::Recording;
use lumped::shaft18::*;
use nalgebra::DVector;
mod gearbox;
use gearbox::light;

#[test]
fn explore() {
    let env = |k: &str, d: f64| std::env::var(k).ok().and_then(|v| v.parse().ok()).unwrap_or(d);
    let (b, n) = (env("B", 0.02), env("N", 64.0) as u32);
    let (from, to, step) = (env("FROM", 200.0), env("TO", 1600.0), env("STEP", 50.0));
    let mut w = from;
    while w <= to {
        let mut model = ShaftMechanism::new(&light(w, b)).unwrap();
        let period = model.mesh_period(0).unwrap();
        let q = model.static_state(0.0).unwrap();
        let nn = q.len();
        let mut state = State::new(0.0, q, DVector::zeros(nn));
        let scale = model.scale();
        let mut go = |state: &mut State, periods: usize| -> Vec<f64> {
            (0..periods).map(|_| 1e3 * model.strobe(0, Scheme::RungeKutta4, n, state).unwrap().compression).collect()
        };
        go(&mut state, 300);
        let start: Vec<f64> = state.q.iter().chain(state.v.iter()).copied().collect();
        let sc: Vec<f64> = scale.iter().map(|x| *x * 1e-2).chain(scale.iter().map(|x| x * 1e-2 / period)).collect();
        let pts = go(&mut state, 100);
        let plan = study::LyapunovPlan { stretch: period, settling: 100, stretches: 200, distance: 1e-6 };
        let l = study::largest_lyapunov(&start, &sc, &plan, |x, k| {
            let mut st = State::new(k as f64 * period, DVector::from_column_slice(&x[..nn]), DVector::from_column_slice(&x[nn..]));
            go(&mut st, 1);
            Ok::<_, ()>(st.q.iter().chain(st.v.iter()).copied().collect())
        }).unwrap();
        let branch = study::Branch { value: w, points: pts };
        let [lo, hi] = branch.extent().unwrap();
        println!("{w:6.0} rad/s f_m {:.0} Hz: points {} in {lo:.2} .. {hi:.2} um, lyapunov {:.1} +- {:.1} 1/s = {:.4} a period", 1.0/period, branch.distinct(0.02), l.exponent, l.error, l.exponent * period);
        w += step;
    }
}

#[test]
fn side() {
    for speed in [TAU * 50.0] {
    for b in [0.0, 0.0125, 0.025, 0.05] { for ecc in [0.0, 0.01] { for torque in [2e4, 1e5] {
        let mut s = light(speed, b);
        s.torques[0].torque = torque;
        s.torques[1].torque = torque * 46.0 / 30.0;
        s.meshes[0].run_out[0].eccentricity = ecc;
        let mut model = ShaftMechanism::new(&s).unwrap();
        let period = model.mesh_period(0).unwrap();
        let plan = Recording { scheme: Scheme::RungeKutta4, control: StepControl::Fixed(period / 64.0), settle: 0.2, duration: 0.8, every: 2 };
        let rows = model.history(0, &plan).unwrap().rows;
        let f: Vec<f64> = rows.iter().map(|r| r.normal_force).collect();
        let lost = rows.iter().filter(|r| r.compression.abs() < b).count() as f64 / rows.len() as f64;
        let sp = study::spectrum(&f, 32.0 / period, study::Window::BlackmanHarris).unwrap();
        let mut text = String::new();
        for h in [1.0, 2.0, 3.0] {
            let c = h / period;
            let a = |d: f64| sp.near(c + d).amplitude;
            text += &format!(" | {c:.0} Hz: {:.1} N, -+1 {:.2} {:.2}, -+2 {:.2} {:.2}, between {:.3}", a(0.0), a(-50.0), a(50.0), a(-100.0), a(100.0), a(25.0));
        }
        println!("b {b} ecc {ecc} T {torque}: lost {lost:.2}{text}");
    }}}}
}
