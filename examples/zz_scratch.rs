use linecontact::reference::*;
use linecontact::*;
fn main() {
    let form = Cosine::new(0.1f64, 2.0, 0.7).unwrap();
    let b = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &b).unwrap().kappa(1.0).single_interval(true);
    let s = contact.solve(Control::Load(form.load(1.0))).unwrap();
    for x in [0.71, 0.75, 0.8, 0.85, 0.9, 0.95, 0.98, 1.0] {
        println!(
            "{x} gap {:?} slope {:?} h {} g {}",
            s.gap_at(x),
            s.gap_slope(x),
            form.height(x),
            form.slope(x)
        );
    }
    println!("{:?}", s.certify());
}
