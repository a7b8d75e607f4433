use stickslip_tip::*;
use stickslip_tip::memory::*;
fn run(model:&Model, kick:f64, dur:f64, tol:f64, m:&str)->(Trajectory,Work,f64){
    let x=14.0; let r=model.r();
    let t1=(x+model.steady_lag())/r;
    let s=InitialSurface::steady(model,x); let f=Force::default();
    let t0=std::time::Instant::now();
    let mut it=Integrator::new(model,&s,&f,match m {"direct"=>Box::new(Direct::new(model.tip().clone())),"fft"=>Box::new(Fft::new(model.tip().clone())),_=>Box::new(Auto::new(model.tip().clone()))},(t1,model.steady_lag()+kick),tol);
    let end=t1+dur; let mut steps=vec![];
    while it.t()<end { steps.push(it.step(end).unwrap()); }
    (Trajectory::new(r,steps),it.work(),t0.elapsed().as_secs_f64())
}
fn main(){
    let a:Vec<f64>=std::env::args().skip(1).map(|s|s.parse().unwrap()).collect();
    let m=std::env::var("MEM").unwrap_or("direct".into());let (alpha,beta,r,kick,dur)=(a[0],a[1],a[2],a[3],a[4]);
    let model=Model::new(TipFunction::triple_gaussian(beta,1.0).unwrap(),alpha,r).unwrap();
    let (rf,w,s)=run(&model,kick,dur,1e-13,"direct");
    println!("ref steps {} rej {} newton {} {:.3}s  l end {:.6} maxl {:.5}",w.steps,w.rejected,w.newton_iterations,s,rf.l(rf.end()), (0..=2000).map(|i| rf.l(rf.start()+dur*i as f64/2000.)).fold(-1e9,f64::max));
    for k in 3..=12 {
        let tol=10f64.powi(-k);
        let (tr,w,s)=run(&model,kick,dur,tol,&m);
        let n=20000; let mut e:f64=0.; let mut en:f64=0.;
        for i in 0..=n { let t=tr.start()+dur*i as f64/n as f64; e=e.max((tr.l(t)-rf.l(t)).abs()); }
        for st in tr.steps(){ en=en.max((tr.l(st.t)-rf.l(st.t)).abs()); }
        println!("tol 1e-{k}: steps {} rej {} newton/step {:.2} err/tol {:.3} node err/tol {:.2e}  {:.4}s",w.steps,w.rejected,w.newton_iterations as f64/(w.steps+w.rejected) as f64,e/tol,en/tol,s);
    }
}
