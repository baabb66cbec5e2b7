#include <cstdio>
#include <cstdlib>
#include "calibration/whole_loop.h"
#include "fusee/base/text.h"
#include "fusee/calibration/words.h"
#include "fusee/correction/correction.h"
#include "fusee/joint/simulate.h"
#include "rig/judge.h"
#include "rig/truths.h"
using namespace fusee; using namespace fusee::rig;
static double tabled(const std::vector<CompensationRow>& table, double alpha, bool up, bool curve) {
  const auto of = [&](const CompensationRow& row) { return up ? row.alpha_up - (curve?0:row.curve_up) : row.alpha_down - (curve?0:row.curve_down); };
  std::size_t i=1; 
  const bool grows = of(table.back())>of(table.front());
  while (i+1<table.size() && (grows? of(table[i])<alpha : of(table[i])>alpha)) ++i;
  const CompensationRow& low = table[i-1];
  return low.theta + (table[i].theta - low.theta) * (alpha - of(low)) / (of(table[i]) - of(low));
}
static double rms_of(const std::vector<Log>& logs, const Correction& c, bool curve) {
  double sq=0,n=0;
  for (const Log& log: logs) for (std::size_t i=log.size()/4+1;i<log.size();++i) {
    if (log[i].alpha==log[i-1].alpha) continue;
    double th=tabled(c.table,log[i].alpha,log[i].alpha>log[i-1].alpha,curve);
    if (th<=c.table.front().theta || th>=c.table.back().theta) continue;
    double e=log[i].theta-th; sq+=e*e; n+=1; }
  return std::sqrt(sq/n);
}
int main(int argc,char**argv){
  const std::string fault=argv[1]; int seeds=std::atoi(argv[2]); Protocol p = argc>3 && std::string(argv[3])=="random"?Protocol::random:Protocol::full;
  for(int s=1;s<=seeds;++s){
    Truth t{fault,{}};
    std::string rest=fault; std::size_t k;
    while((k=rest.find('+'))!=std::string::npos){t.faults.push_back(rest.substr(0,k));rest=rest.substr(k+1);} 
    if(rest!="nothing") t.faults.push_back(rest);
    CaseOptions o; o.protocol=p;
    Case c=make_case(t,static_cast<std::uint64_t>(s),o);
    auto folder=std::filesystem::path("/tmp/w/cover/x")/(fault+"_"+std::to_string(s));
    auto runs=write_case(c,folder);
    Measurement m=read_measurement(runs, c.joint.declared);
    CalibrationOptions co; co.audit=false;
    Calibration cal=calibrate(c.joint.declared,m,co);
    Correction cor=correct(c.joint.declared,m,cal);
    SensorPlan sensors=c.sensors; sensors.seed=c.sensors.seed+1000;
    std::vector<Log> fresh=log_runs(c.joint,c.hidden,c.plans,sensors,c.motion);
    double mb=0,ma=0,mn=0;
    if(cal.curve.used){ auto dir=std::filesystem::path("/tmp/w/cover/x")/("n_"+fault+"_"+std::to_string(s)); Case c2=c; c2.logs=fresh; auto r2=write_case(c2,dir); Measurement m2=read_measurement(r2,c.joint.declared);
      Readings model=predict(c.joint.declared,cal.identified,bench_log(m2));
      for(std::size_t r=0;r<m2.runs.size();++r) for(auto&st:m2.runs[r].strokes){ if(st.partial) continue; for(std::size_t i=st.first;i<=st.last;++i){ double a=m2.runs[r].samples[i].alpha; if(a<cal.curve.alpha.front()||a>cal.curve.alpha.back()) continue; double e=m2.runs[r].samples[i].theta-model[r][i]; if(!std::isfinite(e)) continue; mb+=e*e; double f=e-cal.curve.at(a,st.direction>0); ma+=f*f; mn+=1; } }
      mb=degrees(std::sqrt(mb/mn)); ma=degrees(std::sqrt(ma/mn)); }
    std::string un; for(auto&u:cal.unknown) un+=u.factor+" "+fixed(degrees(u.rms),3)+"; ";
    std::string ef; for(auto&e:cal.effects) ef+=e.name+" ";
    double w=-1,wc=-1; if(!cor.table.empty() && cal.curve.used && !cor.has_pulley){ w=degrees(rms_of(fresh,cor,false)); wc=degrees(rms_of(fresh,cor,true)); }
    std::printf("%-22s %d %-14s [%s] unk{%s} used=%d floor=%.4f held %.4f -> %.4f gain %.4f | new run %.4f -> %.4f gain %.4f | model %.4f -> %.4f gain %.4f %s%s\n",fault.c_str(),s,std::string(word(cal.verdict)).c_str(),ef.c_str(),un.c_str(),cal.curve.used,degrees(cal.noise.rms),degrees(cal.curve.held_out_effects),degrees(cal.curve.held_out_rms),degrees(cal.curve.gain),w,wc,w>wc?std::sqrt(w*w-wc*wc):-std::sqrt(wc*wc-w*w),mb,ma,mb>ma?std::sqrt(mb*mb-ma*ma):-std::sqrt(ma*ma-mb*mb),cal.curve.why.c_str(),cor.has_pulley?" PULLEY":"");
    std::fflush(stdout);
  }
}
