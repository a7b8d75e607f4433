#![allow(clippy::unwrap_used, clippy::print_stdout)]
use stickslip_tip::*;
#[test]
fn smoke() {
    let tip = TipFunction::triple_gaussian(0.0, 1.0).unwrap();
    for (b, t, m) in [(None, None, None), (Some(20.0), None, None), (None, Some(10.0), None), (None, None, Some(0.5)), (Some(5.0), Some(10.0), Some(0.5))] {
        let wider = Wider { depth_limit: b, healing_time: t, inertia: m, spring: true };
        let model = Model::under(wider, tip.clone(), 2.6, 1.0).unwrap();
        println!("{wider:?} w0 {} l0 {} h0 {}", model.steady_weight(), model.steady_l(), model.steady_height());
        let mut s = Scenario { kick: 0.01, tolerance: 1e-9, ..Scenario::new(model, 80.0) };
        for mem in [MemoryChoice::Direct, MemoryChoice::Fft, MemoryChoice::Modes] {
            s.memory = mem;
            for tol in [1e-6, 1e-9, 1e-11] { s.tolerance = tol;
            match run(&s) { Ok(r) => println!("  {mem:?} {tol:e} l(60)={:.12} h={:?} {:?}", r.trajectory.lag(60.0)-1.0, r.trajectory.height(60.0), r.work), Err(e) => println!("  {mem:?} {tol:e} {e}") }
            }
        }
    }
}
