





































`include "enc_check.svh"

module biss_frame #(
  parameter bit          BissB    = 1'b1,
  parameter bit          Ssi      = 1'b1,
  parameter bit          Mo       = 1'b1,  
  parameter int Slaves   = 8,     
  parameter int DataBits = 64     
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,       
  
  input  biss_pkg_line_cmd_t    cmd_i,
  input  biss_pkg_line_go_t     go_i,
  input  biss_pkg_line_start_t  start_i,
  input  logic                   bus_i,
  input  biss_pkg_register_ma_t register_ma_i,
  
  input  logic       tick_i,
  input  logic       half_next_i,
  
  output logic       armed_a_o,
  output logic       armed_b_o,
  input  logic       ack_i,
  input  logic       late_i,       
  input  logic       sl_i,
  input  logic       bit_valid_i,
  input  logic       bit_i,
  
  input  logic       len_valid_i,
  input  logic [6:0] len_i,
  input  biss_pkg_offer_t offer_i,
  input  logic       word_done_i,
  output logic       word_load_o,  
  output logic       word_bit_o,
  output logic       word_run_o,   
  
  output logic       ssi_o,        
  output logic       biss_c_o,     
  output logic       rise_o,       
  output logic       final_o,      
  output logic       clocks_o,     
  output biss_pkg_line_status_t status_o,
  output biss_pkg_line_event_t  event_o,
  output logic       ma_o
);

  typedef logic [2:0] state_e; localparam logic [2:0] IDLE = 0, REQUEST = 1, CDS = 2, DATA = 3, STOP = 4, TIMEOUT = 5, RELEASE = 6, REGISTER = 7;

  state_e             state_d;
  state_e             state_q;
  logic [1:0]         cdm_d;
  logic [1:0]         cdm_q;       
  logic               reduced_d;
  logic               reduced_q;
  logic               hold_d;
  logic               hold_q;
  logic               init_d;
  logic               init_q;
  logic               started_d;
  logic               started_q;   
  logic               none_left;   
  logic               one_left;    
  logic               cds_d;
  logic               cds_q;
  logic               load_d;
  logic               load_q;
  logic               enough;
  logic               rise;
  logic               ma_clocks;
  logic               released;
  logic               begin_frame;
  logic               waited;      
  logic               cdm;
  logic               cdm_known;
  logic               biss_c;
  logic               ssi;
  logic               rests;       
  logic [1:0]         protocol;
  logic [1:0]         protocol_q;
  logic               bus;
  logic               bus_q;
  logic               unused;      
  logic               sl_high;     
  logic               frame_end, init_done, init_fail;
  state_e             new_state;
  logic [1:0]         new_cdm;
  logic               new_reduced, new_init, abort;

  enc_sync_bit u_unused (
    .clk_i,
    .rst_ni,
    .data_i (cmd_i.protocol == biss_pkg_UNUSED ||
             (!BissB && cmd_i.protocol == biss_pkg_BISS_B) ||
             (!Ssi && cmd_i.protocol == biss_pkg_SSI)),
    .data_o (unused)
  );

  assign rests       = state_q == IDLE || state_q == TIMEOUT || state_q == RELEASE;
  assign protocol    = rests ? cmd_i.protocol : protocol_q;
  assign bus         = Mo && (rests ? bus_i : bus_q);
  assign biss_c      = BissB ? protocol == biss_pkg_BISS_C : !ssi;
  assign ssi         = Ssi && protocol == biss_pkg_SSI;
  assign sl_high     = sl_i || unused;
  assign begin_frame = go_i.start && start_i.takes_part && state_q == IDLE;
  
  assign cdm         = cds_q ? cdm_q[1] : cdm_q[0];
  assign cdm_known   = cdm_q[1] == cdm_q[0] || state_q == DATA || state_q == STOP ||
                       state_q == TIMEOUT;
  assign enough      = init_q ? armed_a_o
                              : (started_q || bus) && none_left && cdm_known && !len_valid_i;

  biss_ma_drive u_ma (
    .clk_i,
    .rst_ni,
    .por_ni,
    .tick_i,
    .half_next_i,
    .start_i       (go_i.start),
    .begin_i       (begin_frame),
    .clocked_i     (!go_i.register_access),
    .stop_i        (go_i.stop && state_q != RELEASE),
    .enough_i      (enough),
    .cdm_i         (cdm),
    .high_i        (state_q == RELEASE || (state_q == TIMEOUT && sl_high && !hold_q)),
    .register_i    (BissB && state_q == REGISTER),
    .register_ma_i (register_ma_i.level),
    .force_i       (cmd_i.forced),
    .force_level_i (cmd_i.force_level),
    .released_o    (released),
    .rise_o        (rise),
    .clocking_o    (ma_clocks),
    .ma_o
  );

  biss_edge_count #(.Slaves(Slaves), .DataBits(DataBits), .Mo(Mo)) u_edges (
    .clk_i,
    .rst_ni,
    .biss_c_i    (biss_c),
    .ssi_i       (ssi),
    .bus_i       (bus),
    .mo_busy_i   (cmd_i.mo_busy),
    .begin_i     (begin_frame),
    .run_i       (state_q != IDLE),
    .len_valid_i (len_valid_i && !reduced_q),
    .len_i,
    .wait_i      (waited && !bus),
    .rise_i      (rise),
    .two_o       (armed_a_o),
    .two_next_o  (armed_b_o),
    .none_left_o (none_left),
    .one_left_o  (one_left)
  );

  
  assign new_state   = BissB && go_i.register_access ? REGISTER : REQUEST;
  assign new_cdm     = (go_i.init || !(biss_c || ssi)) ? 2'b00 : {start_i.cdm1, start_i.cdm0};
  assign new_reduced = go_i.reduced && !go_i.init;
  assign new_init    = go_i.init && !go_i.register_access;
  assign abort       = go_i.stop && (state_q == IDLE ? !ma_o : state_q != RELEASE);

  
  logic [1:0] cdm_d_shadow; logic cds_d_shadow; logic frame_end_shadow; logic hold_d_shadow; logic init_d_shadow; logic init_done_shadow; logic init_fail_shadow; logic load_d_shadow; logic reduced_d_shadow; logic started_d_shadow; state_e state_d_shadow; logic waited_shadow; logic word_bit_o_shadow; always begin begin
    state_d_shadow     = state_q;
    cdm_d_shadow       = cdm_q;
    reduced_d_shadow   = reduced_q;
    hold_d_shadow      = hold_q;
    init_d_shadow      = init_q;
    started_d_shadow   = started_q;
    cds_d_shadow       = cds_q;
    load_d_shadow      = 1'b0;
    waited_shadow      = 1'b0;
    word_bit_o_shadow  = 1'b0;
    frame_end_shadow   = 1'b0;
    init_done_shadow   = 1'b0;
    init_fail_shadow   = 1'b0;

    case (state_q)
      IDLE: begin
        
        if (begin_frame) begin
          state_d_shadow   = new_state;
          cdm_d_shadow     = new_cdm;
          cds_d_shadow     = 1'b0;
          reduced_d_shadow = new_reduced;
          hold_d_shadow    = cmd_i.hold_cdm;
          init_d_shadow    = new_init;
          started_d_shadow = ssi;
        end else if (released) begin
          state_d_shadow = RELEASE;
        end
      end
      REQUEST: begin
        
        
        if (init_q) begin
          init_done_shadow = ack_i;
          init_fail_shadow = !ack_i && (late_i || ssi);
          if (init_done_shadow || init_fail_shadow) state_d_shadow = TIMEOUT;
        end else if (bit_valid_i && biss_c) begin
          waited_shadow    = !bit_i;
          started_d_shadow = bit_i;
          if (bit_i) state_d_shadow = CDS;
        end else if (ssi || bit_valid_i) begin
          waited_shadow = !ssi && !bit_i;
          if (!waited_shadow) begin
            started_d_shadow   = 1'b1;
            load_d_shadow      = offer_i.any && !reduced_q;
            frame_end_shadow   = !load_d_shadow;
            state_d_shadow     = load_d_shadow ? DATA : ssi ? TIMEOUT : STOP;
          end
        end
      end
      CDS: begin
        
        if (bit_valid_i) begin
          cds_d_shadow     = bit_i;
          load_d_shadow    = offer_i.any && !reduced_q;
          frame_end_shadow = !load_d_shadow;
          state_d_shadow     = load_d_shadow ? DATA : STOP;
        end
      end
      DATA: begin
        
        word_bit_o_shadow = bit_valid_i;
        if (word_done_i) begin
          load_d_shadow    = !offer_i.last;
          frame_end_shadow = offer_i.last;
          if (offer_i.last) state_d_shadow = STOP;
        end
      end
      STOP: begin
        
        if (bit_valid_i) state_d_shadow = TIMEOUT;
      end
      REGISTER: begin
        
        frame_end_shadow = register_ma_i.ends;
        if (register_ma_i.ends) state_d_shadow = TIMEOUT;
      end
      TIMEOUT: begin
        
        if (tick_i && sl_high && !ma_clocks) state_d_shadow = IDLE;
      end
      RELEASE: begin
        
        if (tick_i) state_d_shadow = IDLE;
      end
      default: state_d_shadow = RELEASE;
    endcase

    if (abort) state_d_shadow = RELEASE;
  end cdm_d = cdm_d_shadow; cds_d = cds_d_shadow; frame_end = frame_end_shadow; hold_d = hold_d_shadow; init_d = init_d_shadow; init_done = init_done_shadow; init_fail = init_fail_shadow; load_d = load_d_shadow; reduced_d = reduced_d_shadow; started_d = started_d_shadow; state_d = state_d_shadow; waited = waited_shadow; word_bit_o = word_bit_o_shadow; @(abort or ack_i or begin_frame or biss_c or bit_i or bit_valid_i or cdm_q or cds_q or cmd_i or hold_q or init_q or late_i or ma_clocks or new_cdm or new_init or new_reduced or new_state or offer_i or reduced_q or register_ma_i or released or sl_high or ssi or started_q or state_q or tick_i or word_done_i); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q    <= RELEASE;
      cdm_q      <= '0;
      reduced_q  <= 1'b0;
      hold_q     <= 1'b0;
      init_q     <= 1'b0;
      started_q  <= 1'b0;
      cds_q      <= 1'b0;
      load_q     <= 1'b0;
      protocol_q <= '0;
      bus_q      <= 1'b0;
    end else begin
      state_q    <= state_d;
      cdm_q      <= cdm_d;
      reduced_q  <= reduced_d;
      hold_q     <= hold_d;
      init_q     <= init_d;
      started_q  <= started_d;
      cds_q      <= cds_d;
      load_q     <= load_d;
      
      protocol_q <= protocol;
      bus_q      <= bus;
    end
  end

  assign word_load_o = load_q;
  assign word_run_o  = state_q == DATA && !go_i.stop;
  assign ssi_o       = ssi;
  assign rise_o      = rise;
  assign final_o     = rise && (started_q || bus) && one_left && cdm_known;
  assign clocks_o    = ma_clocks;
  assign biss_c_o    = biss_c;
  assign status_o    = {state_q == IDLE && !released, state_q == TIMEOUT, cds_q, cdm, sl_i};
  assign event_o     = {frame_end, init_done, init_fail};

  `ENC_ASSERT_IF(IdleDoesNotClock_A, clk_i, rst_ni, state_q == IDLE, !ma_clocks)

endmodule
