import { open_browser, run, start, open_page } from "./tests/browser.js";
const b=await open_browser(); let t=Date.now(); const lap=(s)=>{console.log(s,Date.now()-t);t=Date.now()};
const {page}=await open_page(b); lap("open"); await start(page,"balloon",{phantom:"chain"}); lap("start");
const sync=()=>page.evaluate(()=>{const g=page.stage.renderer.getContext(); g.readPixels(0,0,1,1,g.RGBA,g.UNSIGNED_BYTE,new Uint8Array(4))});
await sync(); lap("sync");
for(let i=0;i<3;++i){await run(page,10); lap("10 frames"); await sync(); lap("sync")}
await page.evaluate(()=>{page.stage.renderer.shadowMap.enabled=false}); await run(page,1); await sync(); lap("no shadow compile");
await run(page,10); await sync(); lap("10 no shadow");
await b.close();
