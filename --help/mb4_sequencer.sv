
































`include "enc_check.svh"

module mb4_sequencer (
  input  logic       clk_i,
  input  logic       rst_ni,
  
  input  mb4_pkg_instr_host_t instr_i,
  output mb4_pkg_instr_core_t instr_o,
  
  input  logic       regvers_i,
  input  mb4_pkg_kind_t kind_i,
  input  logic [mb4_pkg_QUIRKS_W-1:0] quirks_i,
  
  input  mb4_pkg_request_t request_i,
  input  logic       missed_i,
  output logic       taken_o,
  output logic       lines_idle_o,
  output logic       running_o,
  output logic       break_o,
  
  output biss_pkg_line_go_t go_o,
  output logic [1:0] start_use_o,     
  input  logic       tick_i,
  input  logic [2*biss_pkg_LINE_STATUS_W-1:0] status_i,
  input  logic [2*biss_pkg_LINE_EVENT_W-1:0]  event_i,
  input  logic [1:0] word_bad_i,      
  
  input  mb4_pkg_mem_state_t mem_i,
  output mb4_pkg_bank_cmd_t bank_o,
  
  output mb4_pkg_frame_flags_t flags_o,
  output logic       init_clear_o,    
  
  output logic       control_begin_o, 
  output logic       register_begin_o, 
  output logic       void_o,          
  output logic       refused_o,       
  input  logic       control_active_i,
  input  logic       control_end_i,
  input  logic       control_stalled_i, 
  input  logic       stale_i          
);

  typedef logic [2:0] state_e; localparam logic [2:0] IDLE = 0, FRAME = 1, FRAME_DONE = 2, INIT = 3, INIT_TIMEOUT = 4;

  state_e           state_d;
  state_e           state_q;
  mb4_pkg_instr_t  held_d, held_q;
  logic             new_d, new_q;  
  logic [1:0]       use_d, use_q;
  logic [1:0]       done_d, done_q;
  logic             bad_d, bad_q;
  logic             reduced_d;
  logic             reduced_q;     
  logic [10:0]      wait_d;
  logic [10:0]      wait_q;        
  logic             written;
  mb4_pkg_instr_t  asked;         
  biss_pkg_line_status_t status1, status2;
  biss_pkg_line_event_t event1, event2;
  logic [1:0]       idle, line_end, init_done, init_fail;
  logic [1:0]       ack;
  logic             start, init, register_access, mo_return, abort;
  logic             frame_end, swap;
  logic             busy, clear_flags, scd_en, ags_error, bank_fail;
  logic             all_idle, sl_low;
  logic             by_instr, begins;  
  logic             register_d, register_q;  
  logic             awaits_d, awaits_q;      

  
  
  
  localparam logic [10:0] INIT_WAIT = 11'h7FF;

  
  enc_count_rx u_written (
    .clk_i,
    .rst_ni,
    .count_i (instr_i.count),
    .pulse_o (written),
    .ack_o   (ack)
  );

  assign {status2, status1} = status_i;
  assign {event2, event1}   = event_i;
  assign asked     = instr_i.written;
  assign idle      = {status2.idle, status1.idle};
  assign line_end  = {event2.frame_end, event1.frame_end};
  assign init_done = {event2.init_done, event1.init_done};
  assign init_fail = {event2.init_fail, event1.init_fail};

  assign all_idle = idle == 2'b11;   
  assign sl_low   = (kind_i.in_use & (idle | {status2.timeout, status1.timeout}) &
                     ~{status2.sl, status1.sl}) != 2'b00;
  assign by_instr = new_q && kind_i.is_frame && kind_i.in_use != 2'b00 &&
                    (!held_q.ags || request_i.infinite);
  assign begins   = new_q && kind_i.in_use != 2'b00 && !held_q.init && state_q != INIT_TIMEOUT;
  assign control_begin_o  = begins && kind_i.is_control && state_q != INIT && !stale_i;
  
  assign register_begin_o = (begins && (kind_i.is_register ||
                                        (kind_i.is_control && stale_i && !control_stalled_i))) ||
                            (new_q && kind_i.is_void && !void_o);
  assign register_access  = init ? !regvers_i : kind_i.is_register;
  assign register_d  = start ? register_access : register_q;
  assign start_use_o = init ? kind_i.init_use : kind_i.frame_use;
  assign reduced_d   = start ? control_active_i &&
                                 held_q.instr == mb4_regs_pkg_INSTR_CONTROL_REDUCED
                               : reduced_q;
  
  assign awaits_d    = (new_q ? kind_i.is_register && held_q.ags && !stale_i : awaits_q) &&
                       !(written || start || void_o);

  logic abort_shadow; logic ags_error_shadow; logic bad_d_shadow; logic bank_fail_shadow; logic break_o_shadow; logic clear_flags_shadow; logic [1:0] done_d_shadow; logic frame_end_shadow; mb4_pkg_instr_t held_d_shadow; logic init_shadow; logic init_clear_o_shadow; logic new_d_shadow; logic refused_o_shadow; logic scd_en_shadow; logic start_shadow; state_e state_d_shadow; logic swap_shadow; logic taken_o_shadow; logic [1:0] use_d_shadow; logic void_o_shadow; logic [10:0] wait_d_shadow; always begin begin
    state_d_shadow      = state_q;
    held_d_shadow       = held_q;
    new_d_shadow        = new_q && (by_instr || state_q != IDLE || held_q.init || stale_i);
    use_d_shadow        = use_q;
    done_d_shadow       = done_q;
    bad_d_shadow        = bad_q;
    wait_d_shadow       = (tick_i && wait_q != 11'd0) ? wait_q - 11'd1 : wait_q;
    start_shadow        = 1'b0;
    init_shadow         = 1'b0;
    abort_shadow        = 1'b0;
    frame_end_shadow    = 1'b0;
    swap_shadow         = 1'b0;
    init_clear_o_shadow = 1'b0;
    scd_en_shadow       = 1'b0;
    ags_error_shadow    = 1'b0;
    bank_fail_shadow    = 1'b0;
    taken_o_shadow      = 1'b0;
    break_o_shadow      = 1'b0;
    void_o_shadow       = 1'b0;
    refused_o_shadow    = 1'b0;

    case (state_q)
      IDLE: begin
        
        
        if (new_q && !new_d_shadow && (!kind_i.is_frame || !held_q.ags)) begin
          held_d_shadow.instr = 3'b000;
          void_o_shadow       = kind_i.is_void;
        end else if (awaits_q && !kind_i.is_register) begin
          held_d_shadow.instr = 3'b000;
          void_o_shadow       = 1'b1;
        end
        if (held_q.init && !mem_i.clears) begin
          if (kind_i.init_use == 2'b00) begin
            held_d_shadow.init  = 1'b0;
            init_clear_o_shadow = 1'b1;
          end else if (all_idle) begin
            start_shadow        = 1'b1;
            init_shadow         = 1'b1;
            init_clear_o_shadow = 1'b1;
            use_d_shadow        = kind_i.init_use;
            done_d_shadow       = ~kind_i.init_use;
            state_d_shadow      = INIT;
          end else if (wait_q == 11'd0) begin
            abort_shadow = 1'b1;
          end
        end else if ((by_instr || request_i.due) && !mem_i.clears && kind_i.in_use != 2'b00 &&
                     !(stale_i && held_q.instr != 3'b000)) begin
          if (mem_i.pending && held_q.holdbank && !kind_i.is_register &&
              quirks_i[mb4_pkg_QUIRK_AGSERR_ON_HOLDBANK]) begin
            taken_o_shadow   = 1'b1;
            ags_error_shadow = 1'b1;
            bank_fail_shadow = 1'b1;
          end else if (sl_low) begin
            taken_o_shadow   = !request_i.agsmin;
            ags_error_shadow = !request_i.agsmin;
            refused_o_shadow = by_instr && (!request_i.agsmin || kind_i.is_register);
            
            if (control_stalled_i && !control_active_i && !control_end_i && held_q.instr[2]) begin
              held_d_shadow.instr = 3'b000;
              void_o_shadow       = 1'b1;
            end
          end else if (all_idle) begin
            taken_o_shadow = 1'b1;
            start_shadow   = 1'b1;
            use_d_shadow   = kind_i.frame_use;
            done_d_shadow  = ~kind_i.frame_use;
            bad_d_shadow   = 1'b0;
            state_d_shadow = FRAME;
          end
          if (taken_o_shadow) new_d_shadow = 1'b0;
          if (ags_error_shadow && !held_q.ags) held_d_shadow.instr = 3'b000;
        end
      end
      FRAME: begin
        
        bad_d_shadow  = bad_q || word_bad_i != 2'b00;
        done_d_shadow = done_q | line_end;
        if (done_d_shadow == 2'b11) begin
          state_d_shadow = FRAME_DONE;
          scd_en_shadow  = !reduced_q && !register_q;
        end
      end
      FRAME_DONE: begin
        
        state_d_shadow   = IDLE;
        frame_end_shadow = !register_q;
        wait_d_shadow    = INIT_WAIT;
        if (!held_q.ags && !new_q) held_d_shadow.instr = 3'b000;
      end
      INIT: begin
        
        
        done_d_shadow    = done_q | init_done | init_fail | line_end;
        ags_error_shadow = (init_fail & use_q) != 2'b00;
        wait_d_shadow    = INIT_WAIT;
        if (done_d_shadow == 2'b11) state_d_shadow = INIT_TIMEOUT;
      end
      INIT_TIMEOUT: begin
        
        if ((use_q & ~idle) == 2'b00 || wait_q == 11'd0) begin
          state_d_shadow     = IDLE;
          held_d_shadow.init = 1'b0;
        end
      end
      default: state_d_shadow = IDLE;
    endcase

    
    if (control_end_i && held_q.instr[2] && (!new_q || control_stalled_i)) begin
      held_d_shadow.instr = 3'b000;
    end
    if (missed_i) ags_error_shadow = 1'b1;
    if (ags_error_shadow && quirks_i[mb4_pkg_QUIRK_AGS_CLEARED_ON_ERROR]) held_d_shadow.ags = 1'b0;

    if (written) begin
      
      
      
      new_d_shadow = asked.instr != 3'b000 &&
              (new_d_shadow || (state_q != FRAME && state_d_shadow != FRAME) || asked.instr != held_q.instr);
      held_d_shadow.holdbank = asked.holdbank;
      held_d_shadow.swbank   = asked.swbank;
      held_d_shadow.ags      = asked.ags;
      held_d_shadow.instr    = asked.instr;
      held_d_shadow.init     = asked.init || held_d_shadow.init;
      swap_shadow            = asked.swbank != held_q.swbank;
      if (asked.brk) begin
        abort_shadow       = 1'b1;
        break_o_shadow     = 1'b1;
        start_shadow       = 1'b0;
        frame_end_shadow   = 1'b0;
        scd_en_shadow      = 1'b0;
        state_d_shadow     = IDLE;
        new_d_shadow       = asked.instr != 3'b000;
        held_d_shadow.init = asked.init;
        ags_error_shadow   = 1'b0;
        wait_d_shadow      = INIT_WAIT;
      end
      if (quirks_i[mb4_pkg_QUIRK_AGSERR_ON_INSTR_WR]) ags_error_shadow = 1'b1;
    end
    clear_flags_shadow = init_clear_o_shadow || break_o_shadow;
  end abort = abort_shadow; ags_error = ags_error_shadow; bad_d = bad_d_shadow; bank_fail = bank_fail_shadow; break_o = break_o_shadow; clear_flags = clear_flags_shadow; done_d = done_d_shadow; frame_end = frame_end_shadow; held_d = held_d_shadow; init = init_shadow; init_clear_o = init_clear_o_shadow; new_d = new_d_shadow; refused_o = refused_o_shadow; scd_en = scd_en_shadow; start = start_shadow; state_d = state_d_shadow; swap = swap_shadow; taken_o = taken_o_shadow; use_d = use_d_shadow; void_o = void_o_shadow; wait_d = wait_d_shadow; @(all_idle or asked or awaits_q or bad_q or by_instr or control_active_i or control_end_i or control_stalled_i or done_q or held_q or idle or init_done or init_fail or kind_i or line_end or mem_i or missed_i or new_q or quirks_i or reduced_q or register_q or request_i or sl_low or stale_i or state_q or tick_i or use_q or wait_q or word_bad_i or written); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q    <= IDLE;
      held_q     <= '0;
      new_q      <= 1'b0;
      use_q      <= '0;
      done_q     <= '0;
      bad_q      <= 1'b0;
      reduced_q  <= 1'b0;
      register_q <= 1'b0;
      awaits_q   <= 1'b0;
      wait_q     <= '0;
    end else begin
      state_q    <= state_d;
      held_q     <= held_d;
      new_q      <= new_d;
      use_q      <= use_d;
      done_q     <= done_d;
      bad_q      <= bad_d;
      reduced_q  <= reduced_d;
      register_q <= register_d;
      awaits_q   <= awaits_d;
      wait_q     <= wait_d;
    end
  end

  
  
  assign mo_return = state_q == INIT_TIMEOUT && !wait_q[10];
  assign instr_o     = {ack, held_q};
  assign go_o        = {start, init, register_access, reduced_d, mo_return, abort};
  assign bank_o      = {state_q == FRAME && !reduced_q && !register_q, frame_end,
                        frame_end && !reduced_q, reduced_d, swap, init && regvers_i};
  assign flags_o     = {busy, clear_flags, scd_en, bad_d, ags_error, bank_fail};
  assign running_o    = state_q != IDLE;
  assign lines_idle_o = all_idle;
  
  assign busy = state_d != IDLE || (new_d && (!held_d.ags || request_i.infinite)) || held_d.init;

  `ENC_ASSERT(BreakIsNotKept_A, clk_i, rst_ni, !held_q.brk)
  `ENC_ASSERT_IF(StartOnIdleLines_A, clk_i, rst_ni, start, all_idle)

endmodule
